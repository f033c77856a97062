#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "storage/sql/statement.hpp"

namespace SQLite {
class Statement;
}

namespace SQLite {
class Exception;
}

namespace dripline::storage::sqlite {

using sql::Statement;

/// A statement of SQLite's, kept by its connection for the next use.
class PreparedCursor final : public sql::Cursor {
 public:
  /// `is_busy` belongs to the kept statement and is cleared at the end of the use; may be null.
  PreparedCursor(std::shared_ptr<SQLite::Statement> statement, bool* is_busy);
  PreparedCursor(const PreparedCursor&) = delete;
  PreparedCursor& operator=(const PreparedCursor&) = delete;
  ~PreparedCursor() override;

  Result<bool> step() override;
  Result<void> run() override;
  Result<void> post() override { return run(); }  // there is nothing to wait for
  void reset() override;

  void bind_integer(int position, std::int64_t value) override;
  void bind_real(int position, double value) override;
  void bind_text(int position, const std::string& value) override;
  void bind_blob(int position, std::span<const std::byte> value) override;
  void bind_null(int position, sql::Kind kind) override;

  std::int64_t integer(int column) const override;
  double real(int column) const override;
  std::string text(int column) const override;
  std::span<const std::byte> blob(int column) const override;
  bool is_null(int column) const override;

 private:
  std::shared_ptr<SQLite::Statement> statement_;
  bool* is_busy_;
};

/// SQLite's refusal as an Error. `extended` is SQLite's extended result code, `subject` the SQL or
/// the file.
Error error_of(int extended, std::string_view message, std::string_view subject);
Error error_of(const SQLite::Exception& exception, std::string_view subject);

}  // namespace dripline::storage::sqlite
