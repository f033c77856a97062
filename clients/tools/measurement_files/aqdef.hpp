#pragma once

#include <cstdint>
#include <vector>

#include "clients/tools/measurement_files/source.hpp"

/// Q-DAS ASCII transfer format (AQDEF): lines of K fields, CRLF, Windows-1252 unless agreed
/// otherwise.
namespace dripline::measurement_files {

enum class AqdefEncoding : std::uint8_t { Windows1252, Utf8 };

struct AqdefProfile {
  AqdefEncoding encoding = AqdefEncoding::Windows1252;
};

/// Both in one: descriptions, then each value as K0001/n with its fields. A program on a machine is
/// a part (K1001, K1082); what it has to be is a characteristic, and one whose limits were changed
/// is another. Errors: Unsupported (a text that Windows-1252 cannot hold; nothing is written),
/// LimitExceeded (over kMaxAqdef characteristics, a value that is not finite),
/// those of source and sink.
Result<void> write_dfq(MeasurementSource& source, const AqdefProfile& profile, const Sink& sink);
/// The descriptions alone.
Result<void> write_dfd(MeasurementSource& source, const AqdefProfile& profile, const Sink& sink);
/// The values alone, a line for each workpiece: the characteristics in their order, separated by
/// 0x0F, their fields by 0x14. What was not measured is there as not valid (attribute 256).
Result<void> write_dfx(MeasurementSource& source, const AqdefProfile& profile, const Sink& sink);

inline constexpr std::size_t kMaxAqdef = 10'000;
/// Of values, in .dfx and in lines of values.
inline constexpr char kFieldEnd = 0x14, kCharacteristicEnd = 0x0F;

/// Reads .dfq, or .dfd and .dfx one after the other; values that are marked as not valid are left
/// out. Only what write_dfq writes comes back: part, characteristic, limits, unit, machine,
/// program, time, part ident. Errors: Syntax (with the line), LimitExceeded (over kMaxAqdef
/// characteristics or parts, a line over 64 KiB).
Result<std::vector<measurement::Measurement>> read_aqdef(std::string_view file,
                                                         const AqdefProfile& profile);

}  // namespace dripline::measurement_files
