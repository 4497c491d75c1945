#include "sim/scenario/FrameFields.hpp"

#include <algorithm>
#include <charconv>
#include <span>

namespace wr::scenario {

namespace {

using Form = FrameField::Form;

template <class Number>
std::int64_t read(const Bytes& body, const FrameField& field) {
  Number value = 0;
  readAt(body, field.offset, value);
  return value;
}

}  // namespace

const FrameField* findField(std::string_view name) {
  const std::span<const FrameField> fields(kFrameFields);
  const auto found = std::ranges::find(fields, name, &FrameField::name);
  return found != fields.end() ? &*found : nullptr;
}

std::int64_t valueOf(const Bytes& body, const FrameField& field) {
  switch (field.form) {
    case Form::U8:
      return read<std::uint8_t>(body, field);
    case Form::I8:
      return read<std::int8_t>(body, field);
    case Form::U16:
      return read<std::uint16_t>(body, field);
    case Form::I16:
      return read<std::int16_t>(body, field);
    case Form::U32:
      return read<std::uint32_t>(body, field);
    case Form::I32:
      return read<std::int32_t>(body, field);
    case Form::Bit:
      return read<std::uint8_t>(body, field) >> field.bit & 1;
  }
  return 0;
}

std::optional<std::int64_t> numberOf(const FrameField& field, std::string_view word) {
  for (const FrameWord& known : kFrameWords) {
    if (known.field == field.name && known.word == word) {
      return known.number;
    }
  }
  if (field.form == Form::Bit && (word == "yes" || word == "no")) {
    return word == "yes" ? 1 : 0;
  }
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return number;
}

}  // namespace wr::scenario
