#include <fmt/chrono.h>
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "clients/tools/measurement_files/aqdef.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Characteristic;
using measurement::Measurement;

struct PartKey {
  std::string program, machine;
  auto operator<=>(const PartKey&) const = default;
};
struct CharacteristicKey {
  std::size_t part = 0;
  std::string name, unit;
  std::optional<double> nominal, lower, upper;
  auto operator<=>(const CharacteristicKey&) const = default;
};

/// What the file describes, in the order of appearance; characteristics are numbered through the
/// file, part after part.
class Catalog {
 public:
  Result<void> add(const Measurement& m) {
    if (!std::isfinite(m.actual)) {
      return fail(Errc::LimitExceeded, "machine {}, {}: a value that is not finite", m.machine,
                  m.characteristic.name);
    }
    const auto [part, is_new_part] =
        parts_.try_emplace(PartKey{m.program, m.machine}, described_.size());
    if (is_new_part) described_.push_back({part->first, {}, 1});
    auto& characteristics = described_[part->second].characteristics;
    const auto [found, is_new] = index_.try_emplace(key(part->second, m), characteristics.size());
    if (!is_new) return {};
    characteristics.push_back(m.characteristic);
    if (++count_ <= kMaxAqdef) return {};
    return fail(Errc::LimitExceeded, "over {} characteristics in one file", kMaxAqdef);
  }

  /// After the last of add().
  void number_parts() {
    std::size_t next = 1;
    for (DescribedPart& part : described_) {
      part.first = next;
      next += part.characteristics.size();
    }
  }
  /// From 1.
  std::size_t number(const Measurement& m) const {
    const std::size_t part = parts_.at({m.program, m.machine});
    return described_[part].first + index_.at(key(part, m));
  }

  struct DescribedPart {
    PartKey key;
    std::vector<Characteristic> characteristics;
    std::size_t first = 1;  ///< number of its first characteristic
  };
  const std::vector<DescribedPart>& parts() const { return described_; }
  std::size_t count() const { return count_; }

 private:
  static CharacteristicKey key(std::size_t part, const Measurement& m) {
    const auto& of = m.characteristic;
    return {part, of.name, of.unit, of.nominal, of.lower, of.upper};
  }

  std::map<PartKey, std::size_t> parts_;
  std::map<CharacteristicKey, std::size_t> index_;
  std::vector<DescribedPart> described_;
  std::size_t count_ = 0;
};

/// Serial number, else the number of the part.
const std::string& ident_of(const Measurement& m) {
  return m.serial.empty() ? m.part : m.serial;
}

/// What the code page does not have is not written as something else.
Result<void> check_characters(const Measurement& m) {
  for (const std::string* text :
       {&m.machine, &m.program, &m.characteristic.name, &m.characteristic.unit, &ident_of(m)}) {
    const std::size_t count = count_outside_windows_1252(*text);
    if (count == 0) continue;
    return fail(Errc::Unsupported,
                "'{}' has {} {} that Windows-1252 does not have: export it in UTF-8 (--utf8, "
                "format=dfq-utf8) where the receiver reads that, or in another format",
                *text, count, count == 1 ? "character" : "characters");
  }
  return {};
}

Result<Catalog> catalog_of(MeasurementSource& source, const AqdefProfile& profile) {
  Catalog catalog;
  const bool is_limited = profile.encoding == AqdefEncoding::Windows1252;
  auto done = source.each([&](const Measurement& m) -> Result<void> {
    if (is_limited) {
      if (auto good = check_characters(m); !good) return good;
    }
    return catalog.add(m);
  });
  if (!done) return fail(done.error());
  if (catalog.count() == 0) return fail(Errc::LimitExceeded, "AQDEF of no measurement");
  catalog.number_parts();
  return catalog;
}

/// Lines of K fields in the profile's bytes.
class Lines {
 public:
  explicit Lines(const AqdefProfile& profile) : profile_(profile) {}

  void field(std::string_view name, std::size_t number, std::string_view value) {
    if (value.empty()) return;
    text_ += fmt::format("{}/{} {}\r\n", name, number, encoded(value));
  }
  void limit(std::string_view name, std::size_t number, const std::optional<double>& value,
             unsigned decimals) {
    if (value) field(name, number, decimal_text(*value, decimals));
  }
  void raw(std::string_view text) { text_ += text; }
  std::string encoded(std::string_view value) const {
    const std::string line = one_line(value);
    return profile_.encoding == AqdefEncoding::Windows1252 ? to_windows_1252(line) : line;
  }
  std::string take() { return std::exchange(text_, {}); }

 private:
  AqdefProfile profile_;
  std::string text_;
};

std::string date_text(UtcTime time) {
  return fmt::format("{:%d.%m.%Y/%H:%M:%S}",
                     fmt::gmtime(std::chrono::floor<std::chrono::seconds>(time)));
}

/// K fields in ascending order, which some receivers insist on.
std::string descriptions(const Catalog& catalog, const AqdefProfile& profile) {
  Lines lines(profile);
  lines.raw(fmt::format("K0100 {}\r\n", catalog.count()));
  std::size_t number = 1;
  for (std::size_t p = 0; p < catalog.parts().size(); ++p) {
    const auto& part = catalog.parts()[p];
    const std::string_view program =
        part.key.program.empty() ? "-" : std::string_view(part.key.program);
    lines.field("K1001", p + 1, program);
    lines.field("K1002", p + 1, program);
    lines.field("K1082", p + 1, part.key.machine);
    for (const Characteristic& of : part.characteristics) {
      lines.field("K2001", number, fmt::format("{}", number));
      lines.field("K2002", number, of.name);
      lines.field("K2004", number, "0");
      lines.field("K2022", number, fmt::format("{}", of.decimals));
      lines.limit("K2101", number, of.nominal, of.decimals);
      lines.limit("K2110", number, of.lower, of.decimals);
      lines.limit("K2111", number, of.upper, of.decimals);
      lines.field("K2142", number, of.unit);
      ++number;
    }
  }
  return lines.take();
}

std::string value_fields(const Measurement& m, std::size_t number, const AqdefProfile& profile) {
  Lines lines(profile);
  lines.field("K0001", number, decimal_text(m.actual, m.characteristic.decimals));
  lines.field("K0002", number, "0");
  lines.field("K0004", number, date_text(m.time));
  lines.field("K0014", number, ident_of(m));
  return lines.take();
}

/// The values of one workpiece by the number of their characteristic. A second value of one begins
/// a new line.
class ValueLine {
 public:
  ValueLine(const Catalog& catalog, const Sink& sink) : catalog_(catalog), sink_(sink) {}

  Result<void> add(const Measurement& m) {
    const std::size_t number = catalog_.number(m);
    if (!values_.empty() && (values_.contains(number) || !is_same_part(m, last_))) {
      if (auto done = flush(); !done) return done;
    }
    values_[number] = decimal_text(m.actual, m.characteristic.decimals) + kFieldEnd + "0" +
                      kFieldEnd + date_text(m.time);
    last_ = m;
    return {};
  }
  Result<void> flush() {
    if (values_.empty()) return {};
    std::string line;
    for (std::size_t number = 1; number <= catalog_.count(); ++number) {
      if (number > 1) line += kCharacteristicEnd;
      const auto found = values_.find(number);
      line += found != values_.end() ? found->second : std::string("0") + kFieldEnd + "256";
    }
    values_.clear();
    return sink_(line + "\r\n");
  }

 private:
  const Catalog& catalog_;
  const Sink& sink_;
  std::map<std::size_t, std::string> values_;
  Measurement last_;
};

}  // namespace

Result<void> write_dfd(MeasurementSource& source, const AqdefProfile& profile, const Sink& sink) {
  const auto catalog = catalog_of(source, profile);
  if (!catalog) return fail(catalog.error());
  return sink(descriptions(*catalog, profile));
}

Result<void> write_dfq(MeasurementSource& source, const AqdefProfile& profile, const Sink& sink) {
  const auto catalog = catalog_of(source, profile);
  if (!catalog) return fail(catalog.error());
  if (auto written = sink(descriptions(*catalog, profile)); !written) return written;
  return source.each(
      [&](const Measurement& m) { return sink(value_fields(m, catalog->number(m), profile)); });
}

Result<void> write_dfx(MeasurementSource& source, const AqdefProfile&, const Sink& sink) {
  const auto catalog = catalog_of(source, {AqdefEncoding::Utf8});  // it has no texts
  if (!catalog) return fail(catalog.error());
  ValueLine line(*catalog, sink);
  auto done = source.each([&](const Measurement& m) { return line.add(m); });
  return done ? line.flush() : done;
}

}  // namespace dripline::measurement_files
