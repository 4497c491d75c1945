#include "torture/Comparison.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <string_view>

namespace wr::torture {
namespace {

constexpr std::size_t kBefore = 12;  // records that are shown before a difference

constexpr std::array<std::string_view, 6> kKinds{"enters", "leaves",       "acted",
                                                 "fault",  "check failed", "FP mode in"};

constexpr std::array<std::string_view, 21> kActions{"trigger lines",
                                                    "trigger system exceptions",
                                                    "trigger by number",
                                                    "clear pending",
                                                    "supervisor call",
                                                    "undefined instruction",
                                                    "bus error",
                                                    "trigger in an IT block",
                                                    "set priority",
                                                    "set system priority",
                                                    "set priorities",
                                                    "enable lines",
                                                    "disable lines",
                                                    "enable faults",
                                                    "set grouping",
                                                    "raise base priority",
                                                    "mask interrupts",
                                                    "mask faults",
                                                    "forget FP",
                                                    "wait for interrupt",
                                                    "end"};

constexpr std::array<std::string_view, 5> kState{"ICSR", "SHCSR", "IABR", "ISPR", "masks"};
constexpr std::array<std::string_view, 5> kFault{"CFSR", "HFSR", "BFAR", "PC", "xPSR"};
constexpr std::array<std::string_view, 5> kCheck{"wanted", "found", "", "", ""};
constexpr std::array<std::string_view, 5> kFpMode{"FPSCR", "", "", "", ""};

const std::array<std::string_view, 5>& namesOfWords(Kind kind) {
  switch (kind) {
    case Kind::Fault:
      return kFault;
    case Kind::CheckFailed:
      return kCheck;
    case Kind::FpMode:
      return kFpMode;
    default:
      return kState;
  }
}

std::string detail(const Record& record) {
  if (record.kind == Kind::Acted && record.detail < kActions.size()) {
    return std::string(kActions.at(record.detail));
  }
  return (record.kind == Kind::CheckFailed ? "register " : "exception ") +
         std::to_string(record.detail);
}

std::string lineOf(const Records& records, std::size_t number) {
  return number < records.size() ? described(records[number]) : "nothing more";
}

}  // namespace

std::optional<std::size_t> firstDifference(const Records& left, const Records& right) {
  const auto [inLeft, inRight] =
      std::mismatch(left.begin(), left.end(), right.begin(), right.end());
  if (inLeft == left.end() && inRight == right.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(inLeft - left.begin());
}

std::string described(const Record& record) {
  std::ostringstream text;
  const auto kind = static_cast<std::size_t>(record.kind);
  text << std::string(2 * std::size_t{record.depth}, ' ')
       << (kind < kKinds.size() ? kKinds.at(kind) : "unknown kind") << " " << detail(record)
       << std::hex << std::uppercase << ", link " << unsigned{record.link};
  const auto& names = namesOfWords(record.kind);
  for (std::size_t i = 0; i < names.size() && !names.at(i).empty(); ++i) {
    text << ", " << names.at(i) << " " << record.words.at(i);
  }
  return text.str();
}

std::string context(const Records& left, const Records& right, std::size_t number) {
  std::ostringstream text;
  for (std::size_t i = number < kBefore ? 0 : number - kBefore; i < number; ++i) {
    text << std::setw(8) << i << "       " << lineOf(left, i) << "\n";
  }
  text << std::setw(8) << number << " left  " << lineOf(left, number) << "\n";
  text << std::setw(8) << number << " right " << lineOf(right, number) << "\n";
  return text.str();
}

std::size_t exceptionEvents(const Records& records) {
  return static_cast<std::size_t>(std::ranges::count_if(records, [](const Record& record) {
    return record.kind == Kind::Entered || record.kind == Kind::Left;
  }));
}

std::string failedChecks(const Records& records) {
  std::string text;
  for (const Record& record : records) {
    if (record.kind == Kind::CheckFailed) {
      text += described(record) + "\n";
    }
  }
  return text;
}

bool complete(const Records& records) {
  return !records.empty() && records.back().kind == Kind::Acted &&
         records.back().detail == static_cast<std::uint8_t>(Action::End);
}

}  // namespace wr::torture
