#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"

namespace wr::test {

/// @brief Returns the image under test; the variable WR_IMAGE can name another image.
[[nodiscard]] std::filesystem::path imageFile();

/// @brief Returns the file with the symbols of the image, which is in the same folder.
[[nodiscard]] std::filesystem::path elfFile();

/// @brief Switches a board with the image on. The calls of its firmware are recorded for the test.
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    emulator::Options options = {});

/// @brief Switches a board on with an image that a test has changed.
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    std::vector<std::uint8_t> image, emulator::Options options);

/// @brief Returns the file of the image of a product, which is in the folder of the image under test.
[[nodiscard]] std::filesystem::path imageOf(const std::string& product);

/// @brief Switches a board on that has the image of a product. Its calls are not recorded, because the
/// recordings belong to the image under test.
/// @param product name of the product
/// @param image content of its flash
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchProductOn(
    const std::string& product, std::vector<std::uint8_t> image, emulator::Options options = {});

}  // namespace wr::test
