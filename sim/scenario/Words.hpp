#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace wr::scenario {

/// @brief An error in the text of a scenario. If a whole scenario was read, the message begins with
/// the file and the line.
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @brief The words of one line of a scenario. They are read one after the other. An unexpected
/// word causes a ScenarioError.
class Words {
 public:
  /// @brief Splits a line of a scenario into its words. The character '#' begins a comment.
  /// @param line the line of the scenario
  explicit Words(const std::string& line);

  /// @brief Checks whether all words were read.
  [[nodiscard]] bool done() const { return next_ == words_.size(); }

  /// @brief Checks whether the next word is the given word.
  [[nodiscard]] bool nextIs(std::string_view word) const {
    return !done() && words_[next_] == word;
  }

  /// @brief Checks whether the next word is a whole number.
  [[nodiscard]] bool nextIsNumber() const;

  /// @brief Returns the next word without reading it; empty when there are no more words.
  [[nodiscard]] std::string next() const { return done() ? "" : words_[next_]; }

  /// @brief Reads a word.
  /// @param name name of the word in an error message
  std::string take(const std::string& name);

  /// @brief Reads the next word, which must be the given word.
  void skip(const std::string& word);

  /// @brief Reads the next word if it is the given word.
  /// @return true if it was the next word
  bool takeIf(std::string_view word);

  /// @brief Reads a time in ms, at least 0.
  std::chrono::milliseconds time();

  /// @brief Reads a number of 16 bits.
  std::int16_t value();

  /// @brief Reads a number.
  /// @param name name of the number in an error message
  double number(const std::string& name);

  /// @brief Reads the number of a wheel, 0 to 3.
  std::size_t wheel();

  /// @brief Reads a number of 32 bits, at least 0.
  /// @param name name of the number in an error message
  std::uint32_t natural(const std::string& name);

  /// @brief Reads a byte of two hexadecimal digits.
  std::uint8_t byte();

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

}  // namespace wr::scenario
