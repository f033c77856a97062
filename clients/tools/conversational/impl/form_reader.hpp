#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clients/tools/conversational/form.hpp"
#include "protocol/base/result.hpp"

namespace dripline::conversational {

// A file of events before anything in it means something: the same for TOML and JSON.

using FileValue = std::variant<double, bool, std::string>;

struct FileField {
  std::string name;
  FileValue value;
};

struct FileEvent {
  int line = 0;  ///< 0: not known
  std::vector<FileField> fields;
};

/// Errors: Syntax, with the line; LimitExceeded.
Result<std::vector<FileEvent>> read_toml(std::string_view text);
Result<std::vector<FileEvent>> read_json(std::string_view text);

inline constexpr std::size_t kMaxEvents = 5000;
inline constexpr std::string_view kShape =
    "expected a list of events: [[event]] with type = \"...\" and fields that are texts, numbers, "
    "true or false";

/// Fills an event's fields from a file, checking each. The first error is kept; the
/// rest of the event is not checked.
class FormReader : public Form {
 public:
  /// The file's event must outlive this.
  FormReader(const FileEvent& event, UnitSystem units) : event_(event), units_(units) {}

  void number(const Field& field, Entry& entry) override;
  void whole(const Field& field, std::optional<int>& entry) override;
  void text(const Field& field, std::string& entry) override;
  void feedrate(const Field& field, Feedrate& entry) override;
  void choice(const Field& field, std::span<const std::string_view> names,
              std::size_t& index) override;
  void demand(bool holds, std::string_view text) override;
  void set_units(UnitSystem units) override { units_ = units; }

  /// Call this after the walk: fields that the event does not have are errors.
  void finish();
  UnitSystem units() const { return units_; }
  const std::optional<std::string>& error() const { return error_; }

 private:
  /// The value in the file, if there is one; reports fields that do not apply or are missing.
  const FileValue* find(const Field& field);
  Entry number_of(const Field& field, const FileValue& value);
  Entry rounded(const Field& field, const TypedNumber& typed);
  template <class... Args>
  void report(fmt::format_string<Args...> format, Args&&... args) {
    if (!error_) error_ = fmt::format(format, std::forward<Args>(args)...);
  }

  const FileEvent& event_;
  UnitSystem units_;
  std::optional<std::string> error_;
  std::vector<std::string_view> known_;
};

}  // namespace dripline::conversational
