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

namespace SQLite {
class Statement;
}

namespace SQLite {
class Exception;
}

namespace dripline::storage::sqlite {

/// A prepared statement and its use: bound, stepped, and reset when it leaves its scope. Positions
/// of parameters count from 1, of columns from 0. A position that does not exist is a bug of ours
/// and ends the program. One thread at a time.
class Statement {
 public:
  Statement(Statement&&) noexcept;
  Statement& operator=(Statement&&) = delete;
  ~Statement();

  /// Binds to parameters ?1, ?2 ... in order. Text is copied; a span's bytes are not and must live
  /// as long as this object. nullopt is NULL. Unsigned numbers keep their 64 bits (SQL sees them
  /// as signed).
  template <class... Values>
  Statement& bind(const Values&... values) {
    int position = 0;
    (bind_one(++position, values), ...);
    return *this;
  }

  /// True: there is a row to read. False: done; the next step begins again. Errors: see Database.
  Result<bool> step();
  /// Steps to the end and resets, so that it can be bound and run again.
  Result<void> run();
  void reset();

  // The current row. What the schema declares NOT NULL is read with these,
  std::int64_t integer(int column) const;
  std::uint64_t number(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;  ///< valid until the next step or reset
  UtcTime time(int column) const;
  // and what may be NULL with those.
  bool is_null(int column) const;
  std::optional<std::int64_t> optional_integer(int column) const;
  std::optional<double> optional_real(int column) const;
  std::optional<std::string> optional_text(int column) const;
  std::optional<UtcTime> optional_time(int column) const;

 private:
  friend class Database;
  /// `is_busy` belongs to the cached statement and is cleared at the end of the use.
  Statement(std::shared_ptr<SQLite::Statement> statement, bool* is_busy);

  void bind_one(int position, std::signed_integral auto value) {
    bind_integer(position, static_cast<std::int64_t>(value));
  }
  void bind_one(int position, std::unsigned_integral auto value) {
    bind_integer(position, static_cast<std::int64_t>(value));
  }
  void bind_one(int position, double value) { bind_real(position, value); }
  void bind_one(int position, const std::string& value) { bind_text(position, value); }
  void bind_one(int position, std::string_view value) { bind_text(position, std::string(value)); }
  void bind_one(int position, const char* value) { bind_text(position, value); }
  void bind_one(int position, std::span<const std::byte> value) { bind_blob(position, value); }
  void bind_one(int position, UtcTime value) {
    bind_integer(position, value.time_since_epoch().count());
  }
  void bind_one(int position, std::nullopt_t) { bind_null(position); }
  template <class T>
  void bind_one(int position, const std::optional<T>& value) {
    if (value) {
      bind_one(position, *value);
    } else {
      bind_null(position);
    }
  }
  void bind_integer(int position, std::int64_t value);
  void bind_real(int position, double value);
  void bind_text(int position, const std::string& value);
  void bind_blob(int position, std::span<const std::byte> value);
  void bind_null(int position);

  std::shared_ptr<SQLite::Statement> statement_;
  bool* is_busy_;
};

/// SQLite's refusal as an Error. `extended` is SQLite's extended result code, `subject` the SQL or
/// the file.
Error error_of(int extended, std::string_view message, std::string_view subject);
Error error_of(const SQLite::Exception& exception, std::string_view subject);

}  // namespace dripline::storage::sqlite
