#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "clients/lib/client.hpp"
#include "clients/lib/http.hpp"

/// Parts of the requests that the calls of Client send. Pure.
namespace dripline::client::impl {

HttpRequest get(std::string path);
HttpRequest with_method(std::string method, std::string path);
/// `/api/v1/COLLECTION` and, percent-encoded, `/ITEM`.
std::string path_of(std::string_view collection);
std::string path_of(std::string_view collection, std::string_view item);
/// A part of what is at `path`, which is not empty. An error may replace a part of a few bytes.
HttpRequest get_part(std::string path, std::uint64_t offset, std::uint64_t length);
/// Adds `key=value` to a path's query; nothing for an empty value.
std::string with_query(std::string path, std::string_view key, std::string_view value);
/// The same for a number; nothing without one.
std::string with_number(std::string path, std::string_view key,
                        std::optional<std::uint64_t> number);
std::string with_page(std::string path, const Page& page);
/// Those that are given.
void add_fields(nlohmann::json& body, const FieldChange& change);
/// A body; bytes that are not UTF-8 are replaced.
std::string dumped(const nlohmann::json& body);

}  // namespace dripline::client::impl
