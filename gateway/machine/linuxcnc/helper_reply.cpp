#include "gateway/machine/linuxcnc/helper_reply.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace dripline::machine::linuxcnc {
namespace {

using Json = nlohmann::json;

/// Reads members one after the other; the first that is missing, of another type or out of its
/// limits makes the whole line garbage.
class Reader {
 public:
  explicit Reader(const Json& object) : object_(object) {}
  bool is_good() const { return is_good_; }

  void number(const char* key, double& to) { real(find(key), to); }
  void flag(const char* key, bool& to) {
    const Json& value = find(key);
    if (value.is_boolean())
      to = value.get<bool>();
    else
      is_good_ = false;
  }
  void text(const char* key, std::string& to) {
    const Json& value = find(key);
    if (value.is_string())
      to = value.get<std::string>();
    else
      is_good_ = false;
  }
  template <class Integer>
  void whole(const char* key, Integer& to, std::int64_t low, std::int64_t high) {
    const Json& value = find(key);
    if (!value.is_number_integer()) {
      is_good_ = false;
      return;
    }
    const auto found = value.get<std::int64_t>();
    const bool is_huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
    if (is_huge || found < low || found > high)
      is_good_ = false;
    else
      to = static_cast<Integer>(found);
  }
  void numbers(const char* key, std::array<double, kMaxAxes>& to) {
    const Json& values = find(key);
    if (!values.is_array() || values.size() < kMaxAxes) {
      is_good_ = false;
      return;
    }
    for (std::size_t i = 0; i < kMaxAxes; ++i) real(values[i], to[i]);
  }
  void pairs(const char* key, std::array<double, kMaxAxes>& first,
             std::array<double, kMaxAxes>& second) {
    const Json& values = find(key);
    if (!values.is_array() || values.size() < kMaxAxes) {
      is_good_ = false;
      return;
    }
    for (std::size_t i = 0; i < kMaxAxes; ++i) {
      if (!values[i].is_array() || values[i].size() != 2) {
        is_good_ = false;
        return;
      }
      real(values[i][0], first[i]);
      real(values[i][1], second[i]);
    }
  }

 private:
  static constexpr double kLargest = 1e12;
  const Json& find(const char* key) const {
    static const Json kNothing;
    const auto at = object_.find(key);
    return at == object_.end() ? kNothing : *at;
  }
  void real(const Json& value, double& to) {
    const double found = value.is_number() ? value.get<double>() : NAN;
    if (std::isfinite(found) && std::fabs(found) <= kLargest)
      to = found;
    else
      is_good_ = false;
  }

  const Json& object_;
  bool is_good_ = true;
};

constexpr std::int64_t kManyLines = 1'000'000'000'000;

bool read(Reader& from, HelloReply& to) {
  from.text("version", to.version);
  from.number("units", to.units_per_mm);
  from.whole("axes", to.axes, 1, (1 << kMaxAxes) - 1);
  from.pairs("limits", to.low, to.high);
  from.numbers("velocity", to.velocity);
  from.numbers("acceleration", to.acceleration);
  from.number("rpm", to.max_rpm);
  from.whole("wrapped", to.wrapped, 0, (1 << kMaxAxes) - 1);
  from.whole("read_ahead", to.read_ahead, 0, 1'000'000);
  from.text("startup_code", to.startup_code);
  from.flag("adaptive", to.is_adaptive);
  from.text("settings", to.settings);
  return from.is_good();
}

bool read(Reader& from, StatusReply& to) {
  from.whole("state", to.state, 1, 4);
  from.whole("interp", to.interpreter, 1, 4);
  from.whole("read", to.read, 0, kManyLines);
  from.whole("motion", to.motion, 0, kManyLines);
  from.whole("queue", to.queue, 0, kManyLines);
  from.flag("inpos", to.is_in_position);
  from.flag("paused", to.is_paused);
  from.flag("homed", to.is_homed);
  from.flag("homing", to.is_homing);
  from.flag("offset", to.has_offset);
  from.whole("system", to.work_system, 0, 9);
  from.numbers("at", to.at);
  from.number("velocity", to.velocity);
  from.whole("tool", to.tool, -1'000'000'000, 1'000'000'000);
  from.number("spindle", to.spindle_rpm);
  from.flag("adaptive", to.is_adaptive);
  from.flag("touching", to.is_touching);
  from.flag("tripped", to.is_tripped);
  from.numbers("probed", to.probed);
  from.whole("inputs", to.inputs, 0, UINT32_MAX);
  from.whole("inputs_above", to.inputs_above, 0, UINT32_MAX);
  return from.is_good();
}

}  // namespace

HelperReply parse_helper_reply(std::string_view line) {
  const GarbageReply garbage{std::string(line.substr(0, 200))};
  const Json object = Json::parse(line, nullptr, false);
  if (!object.is_object()) return garbage;
  Reader from(object);
  if (object.contains("status")) {
    if (!object["status"].is_object()) return garbage;
    Reader inner(object["status"]);
    StatusReply status;
    if (read(inner, status)) return status;
  } else if (object.contains("hello")) {
    HelloReply hello;
    if (read(from, hello)) return hello;
  } else if (object.contains("done")) {
    DoneReply done;
    from.whole("done", done.number, 0, kManyLines);
    from.text("problem", done.problem);
    if (from.is_good()) return done;
  } else if (object.contains("message")) {
    MessageReply message;
    from.whole("message", message.kind, 0, 1000);
    from.text("text", message.text);
    if (from.is_good()) return message;
  } else if (object.contains("signal")) {
    SignalReply signal;
    from.text("signal", signal.name);
    if (object.contains("problem")) {
      from.text("problem", signal.problem);
    } else {
      from.number("value", signal.value.emplace());
    }
    if (from.is_good()) return signal;
  } else if (object.contains("fatal")) {
    FatalReply fatal;
    from.text("fatal", fatal.text);
    if (from.is_good()) return fatal;
  }
  return garbage;
}

std::vector<std::string> HelperLines::feed(std::span<const std::byte> bytes) {
  std::vector<std::string> lines;
  for (const std::byte byte : bytes) {
    const char c = static_cast<char>(byte);
    if (c != '\n') part_ += c;
    if (c == '\n' || part_.size() >= kMaxLine) lines.push_back(std::exchange(part_, {}));
  }
  return lines;
}

}  // namespace dripline::machine::linuxcnc
