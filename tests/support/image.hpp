#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"

namespace wr::test {

/// @brief Returns the image under test. The environment variable WR_IMAGE can select another image.
[[nodiscard]] std::filesystem::path imageFile();

/// @brief Returns the file with the symbols of the image, which is in the same folder.
[[nodiscard]] std::filesystem::path elfFile();

/// @brief Switches on a board with the image under test. The calls of its firmware are recorded for
/// the test.
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    emulator::Options options = {});

/// @brief Switches on a board with an image that a test has changed.
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    std::vector<std::uint8_t> image, emulator::Options options);

/// @brief Returns the file of a product's image. It is in the folder of the image under test.
[[nodiscard]] std::filesystem::path imageOf(const std::string& product);

/// @brief Switches on a board with the image of a product. Its calls are not recorded, because the
/// recordings belong to the image under test.
/// @param product name of the product
/// @param image content of the flash
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchProductOn(
    const std::string& product, std::vector<std::uint8_t> image, emulator::Options options = {});

}  // namespace wr::test
