#include "sim/gdb/RepeatedLine.hpp"

#include <algorithm>

namespace wr::gdb {

std::size_t RepeatedLine::read(std::span<std::uint8_t> bytes) {
  if (next_ == reads_.size()) {
    const std::size_t count = line_->read(bytes);
    const auto got = bytes.first(count);
    reads_.emplace_back(got.begin(), got.end());
  } else {
    std::ranges::copy(reads_[next_], bytes.begin());
  }
  return reads_[next_++].size();
}

bool RepeatedLine::write(std::span<const std::uint8_t> bytes) {
  return next_ < reads_.size() || line_->write(bytes);
}

}  // namespace wr::gdb
