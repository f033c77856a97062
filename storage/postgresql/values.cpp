#include "storage/postgresql/values.hpp"

#include <libpq-fe.h>
#include <algorithm>
#include <iterator>

#include "protocol/base/invariant.hpp"
#include "storage/postgresql/text_bytes.hpp"

namespace dripline::storage::postgresql {
namespace {

// pg_type.dat of PostgreSQL: these numbers never change.
constexpr unsigned kBool = 16, kBytea = 17, kInt8 = 20, kInt2 = 21, kInt4 = 23, kText = 25,
                   kFloat4 = 700, kFloat8 = 701, kNumeric = 1700;

std::uint64_t big_endian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (const std::byte byte : bytes) value = value << 8 | std::to_integer<std::uint64_t>(byte);
  return value;
}

std::string big_endian(std::uint64_t value) {
  std::string bytes(8, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<char>(value >> (8 * (7 - i)));
  return bytes;
}

/// What a sum of integers comes as: digits to the base 10000, the first worth 10000^weight.
std::int64_t numeric(std::span<const std::byte> bytes) {
  invariant(bytes.size() >= 8, "a numeric has a head of 8 bytes");
  const auto word = [&](std::size_t at) {
    return static_cast<std::int16_t>(big_endian(bytes.subspan(2 * at, 2)));
  };
  const std::int16_t digits = word(0), weight = word(1), sign = word(2);
  std::int64_t value = 0;
  for (std::int16_t i = 0; i <= weight; ++i)
    value = value * 10000 + (i < digits ? word(4 + static_cast<std::size_t>(i)) : 0);
  constexpr std::int16_t kNegative = 0x4000;
  return sign == kNegative ? -value : value;
}

}  // namespace

Parameters::Value& Parameters::at(int position) {
  invariant(position >= 1, "positions count from 1");
  const auto index = static_cast<std::size_t>(position - 1);
  if (index >= values_.size()) values_.resize(index + 1);
  return values_[index];
}

void Parameters::set_integer(int position, std::int64_t value) {
  at(position) = {sql::Kind::Integer, false, big_endian(static_cast<std::uint64_t>(value)), {}};
}

void Parameters::set_real(int position, double value) {
  at(position) = {sql::Kind::Real, false, big_endian(std::bit_cast<std::uint64_t>(value)), {}};
}

void Parameters::set_text(int position, const std::string& value) {
  at(position) = {sql::Kind::Text, false, to_stored(value), {}};
}

void Parameters::set_blob(int position, std::span<const std::byte> value) {
  at(position) = {sql::Kind::Blob, false, {}, value};
}

void Parameters::set_null(int position, sql::Kind kind) {
  at(position) = {kind, true, {}, {}};
}

void Parameters::append(Parameters&& other) {
  values_.insert(values_.end(), std::make_move_iterator(other.values_.begin()),
                 std::make_move_iterator(other.values_.end()));
  other.values_.clear();
}

bool Parameters::has_blobs() const {
  return std::ranges::any_of(
      values_, [](const Value& value) { return value.kind == sql::Kind::Blob && !value.is_null; });
}

std::string Parameters::kinds() const {
  std::string kinds;
  for (const Value& value : values_) kinds += static_cast<char>(value.kind);
  return kinds;
}

std::vector<unsigned> Parameters::types() const {
  std::vector<unsigned> types;
  for (const Value& value : values_) {
    switch (value.kind) {
      case sql::Kind::Integer:
        types.push_back(kInt8);
        break;
      case sql::Kind::Real:
        types.push_back(kFloat8);
        break;
      case sql::Kind::Text:
        types.push_back(kText);
        break;
      case sql::Kind::Blob:
        types.push_back(kBytea);
        break;
      case sql::Kind::Unknown:
        types.push_back(0);
        break;
    }
  }
  return types;
}

Parameters::Arrays Parameters::arrays() const {
  Arrays arrays;
  for (const Value& value : values_) {
    const bool is_blob = value.kind == sql::Kind::Blob;
    const char* bytes =
        is_blob ? reinterpret_cast<const char*>(value.foreign.data()) : value.own.data();
    if (bytes == nullptr) bytes = "";  // an empty blob is not NULL
    arrays.values.push_back(value.is_null ? nullptr : bytes);
    arrays.lengths.push_back(static_cast<int>(is_blob ? value.foreign.size() : value.own.size()));
    arrays.formats.push_back(1);
  }
  return arrays;
}

bool is_null(pg_result* result, int row, int column) {
  invariant(column >= 0 && column < PQnfields(result), "the column is one of the statement's");
  return PQgetisnull(result, row, column) != 0;
}

std::span<const std::byte> bytes_at(pg_result* result, int row, int column) {
  if (is_null(result, row, column)) return {};
  return {reinterpret_cast<const std::byte*>(PQgetvalue(result, row, column)),
          static_cast<std::size_t>(PQgetlength(result, row, column))};
}

std::int64_t integer_at(pg_result* result, int row, int column) {
  const auto bytes = bytes_at(result, row, column);
  if (bytes.empty()) return 0;
  switch (PQftype(result, column)) {
    case kInt8:
      return static_cast<std::int64_t>(big_endian(bytes));
    case kInt4:
      return static_cast<std::int32_t>(big_endian(bytes));
    case kInt2:
      return static_cast<std::int16_t>(big_endian(bytes));
    case kBool:
      return static_cast<std::int64_t>(big_endian(bytes));
    case kNumeric:
      return numeric(bytes);
    default:
      invariant(false, "the column is an integer");
      return 0;
  }
}

double real_at(pg_result* result, int row, int column) {
  const auto bytes = bytes_at(result, row, column);
  if (bytes.empty()) return 0;
  switch (PQftype(result, column)) {
    case kFloat8:
      return std::bit_cast<double>(big_endian(bytes));
    case kFloat4:
      return std::bit_cast<float>(static_cast<std::uint32_t>(big_endian(bytes)));
    default:
      return static_cast<double>(integer_at(result, row, column));
  }
}

std::string text_at(pg_result* result, int row, int column) {
  const auto bytes = bytes_at(result, row, column);
  return from_stored({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace dripline::storage::postgresql
