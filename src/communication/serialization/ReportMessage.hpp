#pragma once

#include "communication/serialization/ReportData.hpp"
#include "communication/serialization/Serializable.hpp"

namespace wr {

/// @brief One report: the results of one control cycle.
/// @function Writes the data of a report for the PC, and marks each missing value as missing.
/// @secret The fields of a report, and the bits that mark a missing value.
/// @role{serializer, Concrete Element}
class ReportMessage final : public Serializable {
 public:
  /// @param data values of the report; they must exist as long as this object
  explicit ReportMessage(const ReportData& data);

  /// @brief Writes the report. For a missing value, the field and its validity bit are 0. If a
  /// value is out of the range of its field, the nearest value of the range is written.
  /// @param writer the destination
  /// @return false when the destination has no space for the whole report
  /// @isr{no}
  /// @satisfies FR-61
  /// @satisfies FR-62
  /// @satisfies FR-63
  /// @satisfies FR-65
  /// @satisfies FR-66
  /// @satisfies FR-67
  /// @satisfies FR-68
  /// @satisfies FR-69
  /// @satisfies FR-177
  /// @satisfies FR-242
  /// @satisfies FR-249
  [[nodiscard]] bool writeTo(Writer& writer) const override;

 private:
  const ReportData& data_;
};

}  // namespace wr
