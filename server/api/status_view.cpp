#include "server/api/status_view.hpp"

#include <nlohmann/json.hpp>

#include "protocol/dds/members.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

constexpr std::string_view kAxes = "XYZABCUVW";

json letter(std::size_t axis) {
  return std::string(1, kAxes[axis]);
}

/// By axis letter, for the axes whose bit is set; bit 0 is X.
template <std::size_t N>
json axes_json(unsigned axes, const std::array<double, N>& values) {
  json object = json::object();
  for (std::size_t i = 0; i < N; ++i) {
    if ((axes >> i & 1) != 0) object[letter(i)] = values[i];
  }
  return object;
}

json axis_letters(unsigned axes) {
  json letters = json::array();
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    if ((axes >> i & 1) != 0) letters.push_back(letter(i));
  }
  return letters;
}

/// Visits the members of a status and of what it contains.
class StatusWriter {
 public:
  /// `axes`: those that the machine has.
  explicit StatusWriter(unsigned axes) : axes_(axes) {}

  template <class T, class Field, class... Rules>
  void operator()(const dds::Member<T, Field>& member, const Rules&... rules) {
    if constexpr (!(std::same_as<Rules, dds::Internal> || ...)) {
      put(member.name, member.value, rules...);
    }
  }
  json take() { return std::move(object_); }

 private:
  template <class T>
  void put(std::string_view name, const T& value, const auto&...) {
    constexpr std::string_view kClaim = "is_";
    if (name.starts_with(kClaim)) name.remove_prefix(kClaim.size());
    object_[std::string(name)] = shown(value);
  }
  void put(std::string_view, bool is_inch, dds::InchOrMetric) {
    object_["units"] = is_inch ? "inch" : "mm";
  }
  void put(std::string_view name, std::int64_t number, dds::NoneIfNegative) {
    object_[std::string(name)] = number < 0 ? json(nullptr) : json(number);
  }
  void put(std::string_view name, const std::optional<std::uint8_t>& axis, dds::AxisNumber) {
    object_[std::string(name)] = axis ? letter(*axis) : json(nullptr);
  }
  void put(std::string_view name, std::uint8_t axes, dds::MainAxisSet) {
    object_[std::string(name)] = axis_letters(axes);
  }

  json shown(bool value) const { return value; }
  json shown(double value) const { return value; }
  template <std::integral T>
  json shown(T value) const {
    return value;
  }
  json shown(const std::string& text) const { return text.empty() ? json(nullptr) : json(text); }
  json shown(UtcTime time) const { return to_iso8601(time); }
  json shown(dds::Enumeration auto value) const {
    const std::string_view word = dds::to_string(value);
    return word == "unknown" ? json(nullptr) : json(word);
  }
  template <std::size_t N>
  json shown(const std::array<double, N>& values) const {
    return axes_json(axes_, values);
  }
  template <class T>
  json shown(const std::optional<T>& value) const {
    return value ? shown(*value) : json(nullptr);
  }
  template <class T>
  requires std::is_class_v<T> json shown(const T& message)
  const {
    StatusWriter writer(axes_);
    dds::members(writer, message);
    return writer.take();
  }
  json shown(const dds::ProgramFrame& frame) const {
    StatusWriter writer(axes_);
    dds::members(writer, frame);
    json view = writer.take();
    view["pole"] = frame.pole_axes != 0 ? axes_json(frame.pole_axes, frame.pole) : json(nullptr);
    return view;
  }

  unsigned axes_;
  json object_ = json::object();
};

}  // namespace

json status_json(const dds::Status& status) {
  StatusWriter writer(status.axes);
  dds::members(writer, status);
  json view = writer.take();
  if (status.coordinates) {
    std::array<double, 9> distance{};
    for (std::size_t i = 0; i < distance.size(); ++i) {
      distance[i] = status.coordinates->target[i] - status.position[i];
    }
    view["coordinates"]["distance_to_go"] = axes_json(status.axes, distance);
  }
  return view;
}

}  // namespace dripline::api
