#pragma once

#include "communication/serialization/ReportData.hpp"
#include "communication/serialization/Serializable.hpp"

namespace wr {

/// @brief One report: the results of one control cycle.
/// @function Writes the data of a report for the PC, and marks the values that are missing.
/// @secret The fields of a report, and how a missing value is marked.
/// @role{serializer, Concrete Element}
class ReportMessage final : public Serializable {
 public:
  /// @brief Binds the report to its data.
  /// @param data values of the report; they exist as long as the report
  explicit ReportMessage(ReportData& data);

  [[nodiscard]] bool readFrom(Reader& reader) override;

  /// @brief Writes the report. A missing value is written as 0 and its bit of validity is 0. A
  /// value out of the range of its field is written as the nearest value in the range.
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
  ReportData& data_;
};

}  // namespace wr
