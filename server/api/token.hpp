#pragma once

#include <string>

namespace dripline::api {

/// A bearer token and the name its changes are audited under.
struct Token {
  std::string name;
  std::string secret;
};

/// Does `authorization` ("Bearer ...") carry this token? Takes the same time wherever they differ.
bool is_authorized(const Token& token, const std::string& authorization);

}  // namespace dripline::api
