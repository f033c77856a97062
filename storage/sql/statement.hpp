#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::storage::sql {

/// Of a value that is bound. An engine that types its parameters takes a NULL's from here too.
enum class Kind : char { Integer = 'i', Real = 'r', Text = 't', Blob = 'b', Unknown = 'n' };

/// What an engine makes of a prepared statement; used through Statement alone, whose header says
/// what each function promises.
class Cursor {
 public:
  virtual ~Cursor() = default;
  virtual Result<bool> step() = 0;
  virtual Result<void> run() = 0;
  virtual Result<void> post() = 0;
  virtual void reset() = 0;

  virtual void bind_integer(int position, std::int64_t value) = 0;
  virtual void bind_real(int position, double value) = 0;
  virtual void bind_text(int position, const std::string& value) = 0;
  virtual void bind_blob(int position, std::span<const std::byte> value) = 0;
  virtual void bind_null(int position, Kind kind) = 0;

  virtual std::int64_t integer(int column) const = 0;
  virtual double real(int column) const = 0;
  virtual std::string text(int column) const = 0;
  virtual std::span<const std::byte> blob(int column) const = 0;
  virtual bool is_null(int column) const = 0;
};

/// A prepared statement and its use: bound, stepped, and reset when it leaves its scope. Positions
/// of parameters count from 1, of columns from 0. A position that does not exist is a bug of ours
/// and ends the program. One thread at a time.
class Statement {
 public:
  explicit Statement(std::unique_ptr<Cursor> cursor) : cursor_(std::move(cursor)) {}

  /// Binds to parameters ?1, ?2 ... in order. Text is copied; a span's bytes are not and must live
  /// as long as this object. nullopt is NULL. Unsigned numbers keep their 64 bits (SQL sees them
  /// as signed).
  template <class... Values>
  Statement& bind(const Values&... values) {
    int position = 0;
    (bind_one(++position, values), ...);
    return *this;
  }

  /// The same for one parameter, whose type is known only while the program runs.
  template <class T>
  void bind_at(int position, const T& value) {
    bind_one(position, value);
  }
  void bind_null_at(int position, Kind kind) { cursor_->bind_null(position, kind); }

  /// True: there is a row to read. False: done; the next step begins again. Errors: see Database.
  Result<bool> step() { return cursor_->step(); }
  /// Steps to the end and resets, so that it can be bound and run again.
  Result<void> run() { return cursor_->run(); }
  /// As run, for one of many that change rows: an engine across a network does not wait for the
  /// answer. An error may come from a later use of the connection instead, at the latest from the
  /// commit; `Database::changes` then says nothing. Only inside a transaction.
  Result<void> post() { return cursor_->post(); }
  void reset() { cursor_->reset(); }

  // The current row. What the schema declares NOT NULL is read with these,
  std::int64_t integer(int column) const { return cursor_->integer(column); }
  std::uint64_t number(int column) const { return static_cast<std::uint64_t>(integer(column)); }
  double real(int column) const { return cursor_->real(column); }
  std::string text(int column) const { return cursor_->text(column); }
  /// Valid until the next step or reset.
  std::span<const std::byte> blob(int column) const { return cursor_->blob(column); }
  UtcTime time(int column) const { return UtcTime{std::chrono::microseconds{integer(column)}}; }
  // and what may be NULL with those.
  bool is_null(int column) const { return cursor_->is_null(column); }
  std::optional<std::int64_t> optional_integer(int column) const {
    return is_null(column) ? std::nullopt : std::optional(integer(column));
  }
  std::optional<double> optional_real(int column) const {
    return is_null(column) ? std::nullopt : std::optional(real(column));
  }
  std::optional<std::string> optional_text(int column) const {
    return is_null(column) ? std::nullopt : std::optional(text(column));
  }
  std::optional<UtcTime> optional_time(int column) const {
    return is_null(column) ? std::nullopt : std::optional(time(column));
  }

 private:
  template <class T>
  static constexpr Kind kind_of() {
    if constexpr (std::integral<T> || std::same_as<T, UtcTime>) return Kind::Integer;
    if constexpr (std::floating_point<T>) return Kind::Real;
    if constexpr (std::convertible_to<T, std::string_view>) return Kind::Text;
    if constexpr (std::convertible_to<T, std::span<const std::byte>>) return Kind::Blob;
    return Kind::Unknown;
  }

  void bind_one(int position, std::signed_integral auto value) {
    cursor_->bind_integer(position, static_cast<std::int64_t>(value));
  }
  void bind_one(int position, std::unsigned_integral auto value) {
    cursor_->bind_integer(position, static_cast<std::int64_t>(value));
  }
  void bind_one(int position, double value) { cursor_->bind_real(position, value); }
  void bind_one(int position, const std::string& value) { cursor_->bind_text(position, value); }
  void bind_one(int position, std::string_view value) {
    cursor_->bind_text(position, std::string(value));
  }
  void bind_one(int position, const char* value) { cursor_->bind_text(position, value); }
  void bind_one(int position, std::span<const std::byte> value) {
    cursor_->bind_blob(position, value);
  }
  void bind_one(int position, UtcTime value) {
    cursor_->bind_integer(position, value.time_since_epoch().count());
  }
  void bind_one(int position, std::nullopt_t) { cursor_->bind_null(position, Kind::Unknown); }
  template <class T>
  void bind_one(int position, const std::optional<T>& value) {
    if (value) {
      bind_one(position, *value);
    } else {
      cursor_->bind_null(position, kind_of<T>());
    }
  }

  std::unique_ptr<Cursor> cursor_;
};

}  // namespace dripline::storage::sql
