#pragma once

#include <string>

namespace dripline::api {

/// A bearer token and the name under which its changes are audited.
struct Token {
  std::string name;
  std::string secret;
};

/// Whether `authorization` ("Bearer ...") has this token. Takes the same time wherever they differ.
bool is_authorized(const Token& token, const std::string& authorization);

}  // namespace dripline::api
