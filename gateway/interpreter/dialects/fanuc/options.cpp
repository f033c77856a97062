#include "gateway/interpreter/dialects/fanuc/options.hpp"

#include <algorithm>

namespace dripline::interpreter::fanuc {
namespace {

/// What a model row of the control's table decides, where no option says otherwise.
struct ModelRow {
  std::size_t repeat;  ///< as the choices of `repeat_address`
  std::size_t call;    ///< as those of `m98_form`
  int call_depth;
  int last_common;
  int last_kept;
};
constexpr std::array<ModelRow, 4> kModels{
    {{2, 0, 4, 149, 531}, {1, 1, 2, 149, 531}, {1, 1, 4, 199, 599}, {0, 0, 4, 149, 531}}};

/// Reads options one after the other; the first error is kept and ends the reading.
class Reader {
 public:
  explicit Reader(const Options& options) : options_(options) {}

  void flag(std::string_view key, bool& out) { take(options_.flag(key, out), out); }
  void number(std::string_view key, double& out) { take(options_.number(key, out), out); }
  void length(std::string_view key, double& out) {
    Length value = Length::mm(out);
    take(options_.length(key, value), value);
    out = value.mm();
  }
  /// A whole number from `least` up.
  template <class Number>
  void count(std::string_view key, std::int64_t least, std::int64_t most, Number& out) {
    std::int64_t value = static_cast<std::int64_t>(out);
    take(options_.integer(key, value), value);
    if (value < least || value > most) {
      complain("[control] {}: {} is not {} to {}", key, value, least, most);
      return;
    }
    out = static_cast<Number>(value);
  }
  std::size_t choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                     std::size_t fallback) {
    std::size_t value = fallback;
    take(options_.choice(key, allowed, fallback), value);
    return value;
  }
  void integers(std::string_view key, std::vector<std::int64_t>& out) {
    take(options_.integers(key), out);
  }
  void position(std::string_view key, Position& out) { take(options_.position(key), out); }
  std::vector<Position> positions(std::string_view key) {
    std::vector<Position> values;
    take(options_.positions(key), values);
    return values;
  }
  bool has(std::string_view key) const { return options_.find(key) != nullptr; }

  template <class... Args>
  void complain(fmt::format_string<Args...> format, Args&&... args) {
    if (!error_) error_ = Error{Errc::Syntax, fmt::format(format, std::forward<Args>(args)...)};
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  template <class Read, class Out>
  void take(const Result<Read>& read, Out& out) {
    if (!read) {
      if (!error_) error_ = read.error();
    } else {
      out = *read;
    }
  }
  const Options& options_;
  std::optional<Error> error_;
};

AxisValues values_of(const Position& position) {
  AxisValues values{};
  for (const Axis axis : kAllAxes) values[static_cast<std::size_t>(axis)] = position.raw(axis);
  return values;
}

void read_numbers(Reader& read, ControlOptions& control) {
  read.flag("calculator_point", control.calculator_point);
  read.flag("tool_changer", control.has_tool_changer);
  control.decimals_mm = 2 + static_cast<int>(read.choice("increment", {"IS-A", "IS-B", "IS-C"}, 1));
  read.number("feed_unit_inch", control.feed_unit_inch);
  if (!(control.feed_unit_inch > 0)) read.complain("[control] feed_unit_inch: must be above 0");
  read.flag("diameter_offset", control.diameter_offset);
  control.offset_memory =
      static_cast<OffsetMemory>(read.choice("offset_memory", {"A", "B", "C"}, 0));
}

void read_model(Reader& read, ControlOptions& control) {
  const bool is_given = read.has("model");
  const std::size_t model = read.choice("model", {"0M", "6M", "11M", "16M"}, 3);
  control.model = static_cast<Model>(model);
  const ModelRow& row = kModels[model];
  control.repeat_address = static_cast<RepeatAddress>(
      read.choice("repeat_address", {"K", "L", "both"}, is_given ? row.repeat : 2));
  control.call_form =
      static_cast<CallForm>(read.choice("m98_form", {"P8", "L", "both"}, is_given ? row.call : 2));
  control.max_call_depth = static_cast<std::size_t>(row.call_depth);
  read.count("max_call_depth", 1, 16, control.max_call_depth);
  read.count("max_nesting", 1, static_cast<std::int64_t>(kMaxFrames), control.max_nesting);
  read.count("max_loops", 1, 1'000'000'000, control.max_loops);
  read.count("max_blocks", 1, 1'000'000'000'000, control.max_blocks);
  control.last_common = row.last_common;
  control.last_kept = row.last_kept;
  read.count("last_common", 149, 199, control.last_common);
  read.count("last_kept", 531, 999, control.last_kept);
}

void read_start(Reader& read, ControlOptions& control) {
  control.start_units =
      read.choice("start_units", {"in", "mm"}, 1) == 0 ? Units::Inch : Units::Millimetre;
  std::vector<std::int64_t> codes{0, 17, 90, 94, 40, 49, 50, 54, 64, 67, 69, 80, 97, 98, 22, 15};
  std::vector<std::int64_t> given;
  read.integers("start_g", given);
  codes.insert(codes.end(), given.begin(), given.end());
  for (const std::int64_t code : codes) {
    if (code == 20 || code == 21)
      control.start_units = code == 20 ? Units::Inch : Units::Millimetre;
    const bool is_code = code >= 0 && code < 100;
    const std::uint8_t group = is_code ? group_of(static_cast<std::uint8_t>(code)) : kNoGroup;
    // A state that needs more than its code (a center, a number) cannot be had at power on.
    if (group == kNoGroup || group == kOneShot || code == 51 || code == 68 || code == 66 ||
        (group == kCycleGroup && code != 80) || code == 41 || code == 42) {
      read.complain("[control] start_g: G{} is not a state this control can start in", code);
      return;
    }
    control.start_g.push_back(static_cast<std::uint8_t>(code));
  }
}

void read_reference(Reader& read, ControlOptions& control) {
  const std::vector<Position> points = read.positions("reference");
  if (points.size() > control.reference.size()) {
    read.complain("[control] reference: {} points, this control has 4", points.size());
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) control.reference[i] = values_of(points[i]);
}

void read_cycles(Reader& read, ControlOptions& control) {
  if (control.start_units == Units::Inch) {
    control.peck_return = Length::inch(0.004).mm();
    control.peck_clearance = Length::inch(0.04).mm();
    control.peck_tap_return = control.peck_return;
  }
  read.length("g73_return", control.peck_return);
  read.length("g83_clearance", control.peck_clearance);
  read.length("peck_tapping_return", control.peck_tap_return);
  control.peck_tap_leaves = read.choice("peck_tapping", {"high-speed", "standard"}, 0) == 1;
  if (!(control.peck_return >= 0) || !(control.peck_clearance >= 0) ||
      !(control.peck_tap_return >= 0)) {
    read.complain("[control] g73_return, g83_clearance, peck_tapping_return: must not be below 0");
  }
  const std::size_t direction = read.choice("shift_direction", {"+X", "-X", "+Y", "-Y"}, 0);
  control.shift_first = direction == 0 ? 1 : direction == 1 ? -1 : 0;
  control.shift_second = direction == 2 ? 1 : direction == 3 ? -1 : 0;
  Position overrun;
  read.position("single_direction", overrun);
  control.single_direction = values_of(overrun);
}

void read_geometry(Reader& read, ControlOptions& control) {
  read.length("arc_error", control.arc_error);
  control.arc_needs_center = read.choice("arc_without_center", {"line", "alarm"}, 0) == 1;
  control.short_radius_is_semicircle = read.choice("short_radius", {"alarm", "semicircle"}, 0) == 1;
  read.number("scale_default", control.scale_default);
  read.number("rotate_default", control.rotate_default);
  read.flag("rotate_incremental", control.rotate_incremental);
  control.start_up_b = read.choice("startup", {"A", "B"}, 0) == 1;
  control.length_axis_type =
      static_cast<char>('A' + read.choice("length_axis", {"A", "B", "C"}, 0));
}

/// Two positions make limit 1 (least, most), two more the forbidden zone of limit 2.
void read_limits(Reader& read, ControlOptions& control) {
  const std::vector<Position> corners = read.positions("stroke_limits");
  if (corners.size() % 2 != 0 || corners.size() > 4) {
    read.complain(
        "[control] stroke_limits: expected the least and the most position of limit 1, and of "
        "limit 2");
    return;
  }
  constexpr double kFar = 1e9;
  const auto corner = [](const Position& position, double missing) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Axis>(i);
      values[i] = position.has(axis) ? position.raw(axis) : missing;
    }
    return values;
  };
  if (corners.size() >= 2) {
    control.has_limits = true;
    control.limit_low = corner(corners[0], -kFar);
    control.limit_high = corner(corners[1], kFar);
  }
  if (corners.size() == 4) {
    control.zone.low = corner(corners[2], -kFar);
    control.zone.high = corner(corners[3], kFar);
  }
}

void read_macros(Reader& read, ControlOptions& control) {
  control.leading_zero_print = true;
  read.flag("leading_zero_print", control.leading_zero_print);
  read.choice("print_newline", {"LF", "CRLF", "LFCRCR"}, 0);  // a matter of the line, not of traces
  control.print_expands = read.choice("print_overflow", {"cut", "expand"}, 0) == 1;
  std::int64_t range = 0;
  read.count("atan_range", 0, 1, range);
  control.atan_is_signed = range == 1;
  read.flag("reset_clears_locals", control.reset_clears_locals);
  read.flag("reset_clears_commons", control.reset_clears_commons);
  read.integers("g_macro", control.g_macros);
  read.integers("m_macro", control.m_macros);
  if (control.g_macros.size() > 10 || control.m_macros.size() > 10) {
    read.complain("[control] g_macro, m_macro: this control has 10 of each");
  }
  for (const std::int64_t code : control.g_macros) {
    if (code < 1 || code > 255 || code == 65 || code == 66 || code == 67) {
      read.complain("[control] g_macro: G{} cannot call a program", code);
    }
  }
  for (const std::int64_t code : control.m_macros) {
    if (code < 1 || code > 99'999'999) read.complain("[control] m_macro: M{} is no code", code);
  }
  read.flag("t_macro", control.t_macro);
  read.integers("before_m", control.before_m);
}

void read_text_rules(Reader& read, ControlOptions& control) {
  read.flag("semicolon_eob", control.semicolon_eob);
  read.flag("comment_over_eob", control.comment_over_eob);
  read.flag("dnc", control.is_dnc);
  bool unroll = false;
  read.flag("unroll",
            unroll);  // for whoever feeds a real control; the trace is the unrolled program
  std::vector<std::int64_t> levels;
  read.integers("skip_levels", levels);
  for (const std::int64_t level : levels) {
    if (level < 1 || level > 9) {
      read.complain("[control] skip_levels: {} is not 1 to 9", level);
      return;
    }
    control.skip_levels = static_cast<std::uint16_t>(control.skip_levels | (1u << level));
  }
}

}  // namespace

Result<ControlOptions> read_options(const Setup& setup) {
  const Options& options = setup.control;
  auto known = options.check_known({"model",
                                    "calculator_point",
                                    "tool_changer",
                                    "increment",
                                    "start_units",
                                    "start_g",
                                    "repeat_address",
                                    "m98_form",
                                    "offset_memory",
                                    "startup",
                                    "reference",
                                    "g73_return",
                                    "g83_clearance",
                                    "peck_tapping",
                                    "peck_tapping_return",
                                    "shift_direction",
                                    "single_direction",
                                    "arc_error",
                                    "arc_without_center",
                                    "scale_default",
                                    "rotate_default",
                                    "rotate_incremental",
                                    "leading_zero_print",
                                    "print_newline",
                                    "atan_range",
                                    "reset_clears_locals",
                                    "reset_clears_commons",
                                    "stroke_limits",
                                    "skip_levels",
                                    "m_macro",
                                    "g_macro",
                                    "t_macro",
                                    "semicolon_eob",
                                    "comment_over_eob",
                                    "feed_unit_inch",
                                    "short_radius",
                                    "diameter_offset",
                                    "before_m",
                                    "print_overflow",
                                    "dnc",
                                    "unroll",
                                    "max_call_depth",
                                    "max_nesting",
                                    "max_loops",
                                    "max_blocks",
                                    "last_common",
                                    "last_kept",
                                    "length_axis",
                                    "pins"});
  if (!known) return fail(known.error());
  if (!setup.switches.mirror.empty()) {
    return fail(Errc::Unsupported, "switches.mirror: this control mirrors with G51");
  }
  ControlOptions control;
  Reader read(options);
  read_model(read, control);
  read_numbers(read, control);
  read_start(read, control);
  read_reference(read, control);
  read_cycles(read, control);
  read_geometry(read, control);
  read_limits(read, control);
  read_macros(read, control);
  read_text_rules(read, control);
  control.answers_pins = read.has("pins");
  read.integers("pins", control.pins_at_one);
  if (read.error()) return fail(*read.error());
  if (setup.switches.block_skip) control.skip_levels |= 1u << 1;
  control.optional_stop = setup.switches.optional_stop;
  return control;
}

}  // namespace dripline::interpreter::fanuc
