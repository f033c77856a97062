#include "clients/tools/report_template/line_form.hpp"

#include <re2/re2.h>
#include <algorithm>
#include <array>

#include "protocol/base/decimal.hpp"

namespace dripline::report_template {
namespace {

constexpr std::int64_t kPatternMemory = 256 * 1024;

struct FieldRow {
  std::string_view name;
  FieldKind kind;
};
constexpr std::array kFieldRows{
    FieldRow{"actual", FieldKind::Actual},
    FieldRow{"deviation", FieldKind::Deviation},
    FieldRow{"nominal", FieldKind::Nominal},
    FieldRow{"lower", FieldKind::Lower},
    FieldRow{"upper", FieldKind::Upper},
    FieldRow{"tolerance", FieldKind::Tolerance},
    FieldRow{"upper_deviation", FieldKind::UpperDeviation},
    FieldRow{"lower_deviation", FieldKind::LowerDeviation},
    FieldRow{"count", FieldKind::Count},
    FieldRow{"expected", FieldKind::Expected},
    FieldRow{"characteristic", FieldKind::Characteristic},
    FieldRow{"unit", FieldKind::Unit},
    FieldRow{"part", FieldKind::Part},
    FieldRow{"serial", FieldKind::Serial},
    FieldRow{"tool", FieldKind::Tool},
};

FieldKind kind_of(std::string_view name) {
  const auto* row = std::ranges::find(kFieldRows, name, &FieldRow::name);
  return row == kFieldRows.end() ? FieldKind::Free : row->kind;
}

constexpr bool is_blank(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
}
constexpr bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Whether a blank of the form may match no blank at all.
enum class Piece : std::uint8_t { None, Text, Mark, Word, Number };

/// Makes the regular expression of a form, from left to right.
class FormReader {
 public:
  FormReader(std::string_view form, bool has_decimal_comma)
      : form_(form), number_(has_decimal_comma ? kNumberWithComma : kNumber) {}

  Result<void> read() {
    for (at_ = 0; at_ < form_.size();) {
      const char c = form_[at_];
      if ((c == '{' || c == '}') && at_ + 1 < form_.size() && form_[at_ + 1] == c) {
        add(Piece::Mark, re2::RE2::QuoteMeta(std::string(1, c)));
        at_ += 2;
      } else if (c == '{') {
        if (auto done = read_field(); !done) return done;
      } else if (c == '}') {
        return fail(Errc::Syntax, "form '{}': '}}' without '{{' at {}", form_, at_ + 1);
      } else if (is_blank(c)) {
        has_blank_ = true;
        ++at_;
      } else {
        add(is_word_character(c) ? Piece::Text : Piece::Mark,
            re2::RE2::QuoteMeta(std::string(1, c)));
        ++at_;
      }
    }
    return {};
  }

  std::string pattern;
  std::vector<Field> fields;

 private:
  static constexpr const char* kNumber = R"([ \t]*([+-]?[ \t]*(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)))";
  static constexpr const char* kNumberWithComma =
      R"([ \t]*([+-]?[ \t]*(?:[0-9]+(?:[.,][0-9]*)?|[.,][0-9]+)))";

  void add(Piece piece, const std::string& text) {
    const auto needs_no_blank = [](Piece one) {
      return one == Piece::Number || one == Piece::Mark;
    };
    const bool is_optional = needs_no_blank(piece) || needs_no_blank(last_);
    if (has_blank_ && last_ != Piece::None) pattern += is_optional ? "[ \\t]*" : "[ \\t]+";
    pattern += text;
    last_ = piece;
    has_blank_ = false;
  }

  Result<void> read_field() {
    const auto end = form_.find('}', at_);
    if (end == std::string_view::npos)
      return fail(Errc::Syntax, "form '{}': no '}}' for '{{' at {}", form_, at_ + 1);
    std::string_view inside = form_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    std::string_view type;
    if (const auto colon = inside.find(':'); colon != std::string_view::npos) {
      type = inside.substr(colon + 1);
      inside = inside.substr(0, colon);
    }
    Field field;
    if (const auto dot = inside.find('.'); dot != std::string_view::npos) {
      field.of = inside.substr(dot + 1);
      inside = inside.substr(0, dot);
      if (field.of.empty()) return fail(Errc::Syntax, "form '{}': a field ends with '.'", form_);
    }
    field.name = inside;
    field.kind = kind_of(inside);
    if (inside.empty() || !std::ranges::all_of(inside, is_word_character)) {
      return fail(Errc::Syntax, "form '{}': '{}' is no name of a field: letters, digits and '_'",
                  form_, inside);
    }
    if (!type.empty() && type != "number" && type != "word" && type != "text") {
      return fail(Errc::Syntax, "form '{}': '{}' of field {} is not number, word or text", form_,
                  type, inside);
    }
    const bool has_number = is_number(field.kind) || type == "number";
    if (is_number(field.kind) && (type == "word" || type == "text"))
      return fail(Errc::Conflict, "form '{}': field {} is a number", form_, inside);
    fields.push_back(std::move(field));
    add(has_number ? Piece::Number : Piece::Word, has_number       ? number_
                                                  : type == "text" ? R"((\S(?:.*?\S)?))"
                                                                   : R"((\S+?))");
    return {};
  }

  std::string_view form_;
  std::string number_;
  std::size_t at_ = 0;
  Piece last_ = Piece::None;
  bool has_blank_ = false;
};

/// `actual_X` is actual of X; `my_field` is a free field of that name.
Field field_of_group(const std::string& group) {
  for (const FieldRow& row : kFieldRows) {
    if (group == row.name) return {.name = group, .kind = row.kind, .of = {}};
  }
  // The longest name first: upper_deviation_D is no upper.
  const FieldRow* best = nullptr;
  for (const FieldRow& row : kFieldRows) {
    if (!is_number(row.kind) || !group.starts_with(row.name)) continue;
    if (group.size() <= row.name.size() + 1 || group[row.name.size()] != '_') continue;
    if (best == nullptr || row.name.size() > best->name.size()) best = &row;
  }
  if (best == nullptr) return {.name = group, .kind = FieldKind::Free, .of = {}};
  return {.name = std::string(best->name),
          .kind = best->kind,
          .of = group.substr(best->name.size() + 1)};
}

}  // namespace

bool is_number(FieldKind kind) {
  return kind <= FieldKind::Expected;
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

Result<LineForm> LineForm::of_form(std::string_view form, bool has_decimal_comma) {
  if (form.size() > kMaxForm) {
    return fail(Errc::LimitExceeded, "form of {} characters: at most {}", form.size(), kMaxForm);
  }
  if (trimmed(form).empty()) return fail(Errc::Syntax, "a form is empty");
  FormReader reader(form, has_decimal_comma);
  if (auto done = reader.read(); !done) return fail(done.error());
  LineForm made;
  made.text_ = form;
  made.fields_ = std::move(reader.fields);
  for (std::size_t i = 0; i < made.fields_.size(); ++i)
    made.groups_.push_back(static_cast<int>(i) + 1);
  if (auto done = made.compile(reader.pattern); !done) return fail(done.error());
  return made;
}

Result<LineForm> LineForm::of_pattern(std::string_view pattern) {
  if (pattern.size() > kMaxForm) {
    return fail(Errc::LimitExceeded, "pattern of {} characters: at most {}", pattern.size(),
                kMaxForm);
  }
  LineForm made;
  made.text_ = pattern;
  if (auto done = made.compile(std::string(pattern)); !done) return fail(done.error());
  for (const auto& [name, group] : made.pattern_->NamedCapturingGroups()) {
    made.fields_.push_back(field_of_group(name));
    made.groups_.push_back(group);
  }
  if (made.fields_.size() > kMaxFields) {
    return fail(Errc::LimitExceeded, "pattern '{}': {} fields, at most {}", pattern,
                made.fields_.size(), kMaxFields);
  }
  return made;
}

Result<void> LineForm::compile(const std::string& pattern) {
  if (fields_.size() > kMaxFields) {
    return fail(Errc::LimitExceeded, "form '{}': {} fields, at most {}", text_, fields_.size(),
                kMaxFields);
  }
  re2::RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(kPatternMemory);
  options.set_encoding(re2::RE2::Options::EncodingLatin1);
  auto compiled = std::make_shared<const re2::RE2>(pattern, options);
  if (!compiled->ok()) return fail(Errc::Syntax, "pattern '{}': {}", text_, compiled->error());
  pattern_ = std::move(compiled);
  return {};
}

std::optional<std::vector<FieldText>> LineForm::match(std::string_view line) const {
  const std::string_view text = trimmed(line);
  if (text.size() > kMaxLine) return std::nullopt;
  std::vector<re2::StringPiece> groups(
      static_cast<std::size_t>(pattern_->NumberOfCapturingGroups()) + 1);
  const re2::StringPiece piece(text.data(), text.size());
  if (!pattern_->Match(piece, 0, text.size(), re2::RE2::ANCHOR_BOTH, groups.data(),
                       static_cast<int>(groups.size()))) {
    return std::nullopt;
  }
  std::vector<FieldText> found;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto& group = groups[static_cast<std::size_t>(groups_[i])];
    if (group.data() == nullptr) continue;  // an alternative that was not taken
    found.push_back({&fields_[i], std::string_view(group.data(), group.size())});
  }
  return found;
}

Result<Number> read_number(std::string_view text) {
  std::string digits;
  for (const char c : text) {
    if (!is_blank(c)) digits += c == ',' ? '.' : c;
  }
  const auto decimal = parse_decimal(digits);
  if (!decimal) return fail(decimal.error());
  // More digits than a double has: 99999999999999999 would become 100000000000000000.
  const double value = decimal->value();
  const auto kept = parse_decimal(fmt::format("{:.{}f}", value, int{decimal->scale}));
  if (!kept || kept->digits != decimal->digits) {
    return fail(Errc::LimitExceeded, "{} has more digits than are kept (15 always are)", digits);
  }
  return Number{.value = value, .decimals = decimal->scale};
}

}  // namespace dripline::report_template
