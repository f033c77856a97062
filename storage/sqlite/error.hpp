#pragma once

#include <string_view>

#include "protocol/base/result.hpp"

namespace SQLite {
class Exception;
}

namespace dripline::storage::sqlite {

/// SQLite's refusal as an Error. `extended` is SQLite's extended result code, `subject` the SQL or
/// the file.
Error error_of(int extended, std::string_view message, std::string_view subject);
Error error_of(const SQLite::Exception& exception, std::string_view subject);

}  // namespace dripline::storage::sqlite
