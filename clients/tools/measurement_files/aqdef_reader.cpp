#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <optional>

#include "clients/tools/measurement_files/aqdef.hpp"
#include "clients/tools/measurement_files/text_files.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Measurement;

/// "01.02.2026/13:14:15", the seconds may be missing.
std::optional<UtcTime> date_of(std::string_view text) {
  if (text.size() < 16 || text[2] != '.' || text[5] != '.') return std::nullopt;
  std::string iso = std::string(text.substr(6, 4)) + "-" + std::string(text.substr(3, 2)) + "-" +
                    std::string(text.substr(0, 2)) + "T" + std::string(text.substr(11));
  if (text[10] != '/' && text[10] != ' ') return std::nullopt;
  if (text.size() == 16) iso += ":00";
  const auto time = parse_iso8601(iso + 'Z');
  return time ? std::optional(*time) : std::nullopt;
}

struct Field {
  int key = 0;
  std::size_t number = 0;  ///< 0: of all
  std::string value;
};

class Reader {
 public:
  explicit Reader(const AqdefProfile& profile) : profile_(profile) {}

  Result<void> take_line(std::string_view line) {
    if (line.empty()) return {};
    if (line.size() > kMaxLine) return fail(Errc::LimitExceeded, "over {} bytes", kMaxLine);
    if (line.front() != 'K') return take_values(line);
    auto field = parse(line);
    if (!field) return fail(field.error());
    return take_field(*field);
  }

  std::vector<Measurement> finish() && {
    close_all();
    return std::move(values_);
  }

 private:
  struct Part {
    std::string number, name, machine;
  };
  struct Described {
    std::size_t part = 0;
    std::string code;
    measurement::Characteristic of;
    std::optional<Measurement> open;  ///< a value whose fields are still coming
    bool is_valid = true;
  };

  std::string decoded(std::string_view text) const {
    return profile_.encoding == AqdefEncoding::Windows1252 ? from_windows_1252(text)
                                                           : std::string(text);
  }

  Result<Field> parse(std::string_view line) const {
    Field field;
    const auto space = line.find(' ');
    std::string_view head = line.substr(1, space == std::string_view::npos ? space : space - 1);
    const auto slash = head.find('/');
    const std::string_view key = head.substr(0, slash);
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), field.key);
    if (key.size() != 4 || error != std::errc() || end != key.data() + key.size()) {
      return fail(Errc::Syntax, "'K{}' is no field", one_line(head.substr(0, 20)));
    }
    if (slash != std::string_view::npos) {
      const std::string_view number = head.substr(slash + 1);
      const auto [stop, bad] =
          std::from_chars(number.data(), number.data() + number.size(), field.number);
      if (bad != std::errc() || stop != number.data() + number.size() || field.number > kMaxAqdef) {
        return fail(Errc::Syntax, "K{:04}/{}: a number up to {} is expected", field.key,
                    one_line(number.substr(0, 20)), kMaxAqdef);
      }
    }
    if (space != std::string_view::npos) field.value = decoded(line.substr(space + 1));
    return field;
  }

  Result<void> take_field(const Field& field) {
    if (field.key == 100 || field.number == 0) return {};
    if (field.key >= 1000 && field.key < 2000) return take_part(field);
    if (field.key >= 2000 && field.key < 3000) return take_characteristic(field);
    if (field.key < 100) return take_value_field(field);
    return {};  // catalogs and the rest of the format: not ours
  }

  Result<void> take_part(const Field& field) {
    current_part_ = field.number;
    Part& part = parts_[field.number];
    if (field.key == 1001) part.number = field.value;
    if (field.key == 1002) part.name = field.value;
    if (field.key == 1082) part.machine = field.value;
    return {};
  }

  Result<void> take_characteristic(const Field& field) {
    Described& described = described_[field.number];
    described.part = current_part_;
    auto& of = described.of;
    const auto take_number = [&](std::optional<double>& into) -> Result<void> {
      into = parse_finite(field.value);
      if (into) return {};
      return fail(Errc::Syntax, "K{}/{}: '{}' is no number", field.key, field.number, field.value);
    };
    switch (field.key) {
      case 2001:
        described.code = field.value;
        return {};
      case 2002:
        of.name = field.value;
        return {};
      case 2022:
        of.decimals =
            static_cast<std::uint8_t>(std::clamp(parse_finite(field.value).value_or(3), 0.0, 12.0));
        return {};
      case 2101:
        return take_number(of.nominal);
      case 2110:
        return take_number(of.lower);
      case 2111:
        return take_number(of.upper);
      case 2142:
        of.unit = field.value;
        return {};
      default:
        return {};
    }
  }

  Result<void> take_value_field(const Field& field) {
    const auto found = described_.find(field.number);
    if (found == described_.end()) {
      return fail(Errc::Syntax, "K{:04}/{}: there is no such characteristic", field.key,
                  field.number);
    }
    Described& described = found->second;
    if (field.key == 1) {
      close(described);
      return open(described, field.value);
    }
    if (!described.open)
      return fail(Errc::Syntax, "K{:04}/{} before its value", field.key, field.number);
    if (field.key == 2) described.is_valid = field.value == "0";
    if (field.key == 4) return take_time(described, field.value);
    if (field.key == 14) described.open->serial = field.value;
    return {};
  }

  Result<void> take_time(Described& described, const std::string& text) {
    const auto time = date_of(text);
    if (!time) return fail(Errc::Syntax, "'{}' is no time: 31.12.2026/23:59:59", one_line(text));
    described.open->time = *time;
    return {};
  }

  Result<void> open(Described& described, std::string_view text) {
    const auto value = parse_finite(text);
    if (!value) return fail(Errc::Syntax, "'{}' is no value", one_line(text.substr(0, 40)));
    Measurement m;
    const Part& part = parts_[described.part];
    m.program = part.number == "-" ? "" : part.number;
    m.machine = part.machine;
    m.characteristic = described.of;
    if (m.characteristic.name.empty()) m.characteristic.name = described.code;
    m.actual = *value;
    m.verdict = measurement::judge(m.characteristic, m.actual, measurement::ReworkSide::None);
    described.open = std::move(m);
    described.is_valid = true;
    return {};
  }

  void close(Described& described) {
    if (described.open && described.is_valid) values_.push_back(*std::move(described.open));
    described.open.reset();
  }
  void close_all() {
    for (auto& [number, described] : described_) close(described);
  }

  Result<void> take_values(std::string_view line) {
    std::size_t number = 0;
    do {
      std::string_view fields = take_until(line, kCharacteristicEnd);
      const auto found = described_.find(++number);
      if (found == described_.end())
        return fail(Errc::Syntax, "a value for characteristic {}, which is not there", number);
      close(found->second);
      if (fields.empty()) continue;
      if (auto opened = open(found->second, take_until(fields, kFieldEnd)); !opened) return opened;
      if (const auto attribute = take_until(fields, kFieldEnd); !attribute.empty())
        found->second.is_valid = attribute == "0";
      if (const auto time = take_until(fields, kFieldEnd); !time.empty()) {
        if (auto taken = take_time(found->second, std::string(time)); !taken) return taken;
      }
      close(found->second);
    } while (!line.empty());
    return {};
  }

  AqdefProfile profile_;
  std::map<std::size_t, Part> parts_;
  std::map<std::size_t, Described> described_;
  std::size_t current_part_ = 1;
  std::vector<Measurement> values_;
};

}  // namespace

Result<std::vector<Measurement>> read_aqdef(std::string_view file, const AqdefProfile& profile) {
  Reader reader(profile);
  std::size_t line = 0;
  while (!file.empty()) {
    ++line;
    std::string_view text = take_until(file, '\n');
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (auto taken = reader.take_line(text); !taken) {
      return fail(taken.error().code, "line {}: {}", line, taken.error().what);
    }
  }
  return std::move(reader).finish();
}

}  // namespace dripline::measurement_files
