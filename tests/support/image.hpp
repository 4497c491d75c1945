#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"

namespace wr::test {

/// @brief Returns the file of the firmware image under test. The environment variable WR_IMAGE can
/// select another image.
[[nodiscard]] std::filesystem::path imageFile();

/// @brief Returns the file with the symbols of the firmware image. This file is in the folder of
/// the image.
[[nodiscard]] std::filesystem::path elfFile();

/// @brief Switches on a board with the firmware image under test. Records the calls of the firmware
/// for the test.
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    emulator::Options options = {});

/// @brief Switches on a board with a firmware image that a test has changed.
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchBoardOn(
    std::vector<std::uint8_t> image, emulator::Options options);

/// @brief Returns the file of the firmware image of a product. The file is in the folder of
/// the image under test.
[[nodiscard]] std::filesystem::path imageOf(const std::string& product);

/// @brief Switches on a board with the firmware image of a product. The calls of this image
/// are not recorded, because all recordings must belong to the image under test.
/// @param product name of the product
/// @param image firmware image, which is the content of the flash
/// @param options options of the board; the file with the symbols is added
[[nodiscard]] std::unique_ptr<board_robot::BoardSession> switchProductOn(
    const std::string& product, std::vector<std::uint8_t> image, emulator::Options options = {});

}  // namespace wr::test
