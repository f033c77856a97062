#pragma once

#include <string_view>

#include "server/identity/sessions.hpp"
#include "server/identity/tokens.hpp"
#include "server/identity/users.hpp"

/// The JSON bodies of requests about users and tokens. Pure. Errors: Syntax, LimitExceeded,
/// Unsupported (an unknown role); each names the member, and none repeats a password.
namespace dripline::api {

/// `{user, password, bearer?, hours?}`; the address is left empty.
Result<identity::SignIn> decode_sign_in(std::string_view body);
/// `{name, role, groups?, password?}`.
Result<identity::NewUser> decode_user(std::string_view body);
/// `{role?, groups?, locked?}`.
Result<identity::UserChange> decode_user_change(std::string_view body);
/// `{password, current?}`.
Result<identity::NewPassword> decode_password(std::string_view body);
/// `{name, role?, groups?, days?}`.
Result<identity::NewToken> decode_token(std::string_view body);

}  // namespace dripline::api
