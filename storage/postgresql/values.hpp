#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "storage/sql/statement.hpp"

struct pg_result;

/// Values as they cross the wire: binary, in network order. Types are the few that our schema and
/// its expressions have; another one is a bug of ours and ends the program.
namespace dripline::storage::postgresql {

/// The parameters of one execution. Bytes of a blob are the caller's.
class Parameters {
 public:
  void set_integer(int position, std::int64_t value);
  void set_real(int position, double value);
  void set_text(int position, const std::string& value);
  void set_blob(int position, std::span<const std::byte> value);
  void set_null(int position, sql::Kind kind);

  /// Those of another execution, after these.
  void append(Parameters&& other);
  bool has_blobs() const;

  /// A letter for the kind of each: what a statement is prepared for.
  std::string kinds() const;
  int count() const { return static_cast<int>(values_.size()); }
  /// PostgreSQL's numbers of the types, 0: as the statement says.
  std::vector<unsigned> types() const;
  /// Pointers, lengths and formats, as libpq takes them; valid until something is set.
  struct Arrays {
    std::vector<const char*> values;
    std::vector<int> lengths, formats;
  };
  Arrays arrays() const;

 private:
  struct Value {
    sql::Kind kind = sql::Kind::Unknown;
    bool is_null = true;
    std::string own;                     ///< of a text or number
    std::span<const std::byte> foreign;  ///< of a blob
  };
  Value& at(int position);
  std::vector<Value> values_;
};

bool is_null(pg_result* result, int row, int column);
// Of NULL: 0, or nothing.
std::int64_t integer_at(pg_result* result, int row, int column);
double real_at(pg_result* result, int row, int column);
std::string text_at(pg_result* result, int row, int column);
std::span<const std::byte> bytes_at(pg_result* result, int row, int column);

}  // namespace dripline::storage::postgresql
