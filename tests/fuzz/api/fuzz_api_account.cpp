// The bodies about users and tokens. Properties: what is taken is within its bounds, and a refusal
// has a text.
#include <cstdlib>

#include "server/api/bodies/account_bodies.hpp"
#include "server/identity/account_limits.hpp"

namespace {

template <class T>
void check(const dripline::Result<T>& decoded) {
  if (!decoded && decoded.error().what.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  using identity::AccountLimits;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const auto sign_in = api::decode_sign_in(body);
  check(sign_in);
  if (sign_in && (sign_in->password.size() > AccountLimits::kMaxPassword ||
                  sign_in->life > AccountLimits::kMaxSessionLife || sign_in->life.count() < 1)) {
    std::abort();
  }
  const auto token = api::decode_token(body);
  check(token);
  if (token && (token->life > AccountLimits::kMaxTokenLife || token->life.count() < 1))
    std::abort();
  check(api::decode_user(body));
  check(api::decode_user_change(body));
  check(api::decode_password(body));
  return 0;
}
