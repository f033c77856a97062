#include "server/identity/password_hasher.hpp"

#include <sodium.h>
#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>

namespace dripline::identity {
namespace {

/// The number after `,t=` or `m=` of "$argon2id$v=19$m=65536,t=2,p=1$SALT$DIGEST".
std::optional<std::uint64_t> cost_of(std::string_view digest, std::string_view name) {
  const std::size_t at = digest.find(name);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view text = digest.substr(at + name.size());
  std::uint64_t value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || end == text.data()) return std::nullopt;
  return value;
}

/// A digest that was changed by hand must not take all memory, or an hour.
bool is_affordable(std::string_view digest) {
  constexpr std::uint64_t kKibibyte = 1024;
  if (!digest.starts_with("$argon2id$v=19$m=")) return false;
  const auto memory = cost_of(digest, "$m=");
  const auto passes = cost_of(digest, ",t=");
  return memory && passes && *memory <= PasswordHasher::kMaxMemory / kKibibyte &&
         *passes <= PasswordHasher::kMaxPasses;
}

std::string random_base64(std::size_t size) {
  std::array<unsigned char, 32> bytes{};
  std::array<char, 64> text{};
  randombytes_buf(bytes.data(), size);
  sodium_bin2base64(text.data(), text.size(), bytes.data(), size,
                    sodium_base64_VARIANT_ORIGINAL_NO_PADDING);
  return text.data();
}

std::string digest_of_nobody(const HashingCost& cost) {
  constexpr std::size_t kSalt = 16;
  constexpr std::size_t kDigest = 32;
  if (sodium_init() < 0) std::abort();  // no random numbers
  return fmt::format("$argon2id$v=19$m={},t={},p=1${}${}", cost.memory / 1024, cost.passes,
                     random_base64(kSalt), random_base64(kDigest));
}

}  // namespace

/// The right to compute one digest; given back at the end of its scope.
class PasswordHasher::Turn {
 public:
  explicit Turn(PasswordHasher& hasher) : hasher_(hasher) {
    std::unique_lock lock(hasher_.mutex_);
    const auto& options = hasher_.options_;
    if (hasher_.running_ >= options.at_once) {
      if (hasher_.waiting_ >= options.waiting) return;
      ++hasher_.waiting_;
      hasher_.freed_.wait(lock, [&] { return hasher_.running_ < options.at_once; });
      --hasher_.waiting_;
    }
    ++hasher_.running_;
    hasher_.peak_ = std::max(hasher_.peak_, hasher_.running_);
    is_taken_ = true;
  }
  ~Turn() {
    if (!is_taken_) return;
    const std::lock_guard lock(hasher_.mutex_);
    --hasher_.running_;
    hasher_.freed_.notify_one();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  bool is_taken() const { return is_taken_; }

 private:
  PasswordHasher& hasher_;
  bool is_taken_ = false;
};

namespace {

tl::unexpected<Error> too_many() {
  return fail(Errc::Busy, "too many passwords are being checked: try again in a second");
}

}  // namespace

PasswordHasher::PasswordHasher(const Options& options)
    : options_(options), nobodys_(digest_of_nobody(options.cost)) {}

Result<std::string> PasswordHasher::hash(const std::string& password) {
  const Turn turn(*this);
  if (!turn.is_taken()) return too_many();
  std::array<char, crypto_pwhash_STRBYTES> digest{};
  if (crypto_pwhash_str(digest.data(), password.data(), password.size(), options_.cost.passes,
                        options_.cost.memory) != 0) {
    return fail(Errc::Io, "no memory for the digest of a password: {} bytes", options_.cost.memory);
  }
  return std::string(digest.data());
}

Result<bool> PasswordHasher::verify(const std::string& digest, const std::string& password) {
  const std::string& compared = digest.empty() ? nobodys_ : digest;
  if (!is_affordable(compared))
    return fail(Errc::Corrupt, "the stored digest of a password is none of ours");
  const Turn turn(*this);
  if (!turn.is_taken()) return too_many();
  const bool is_right =
      crypto_pwhash_str_verify(compared.c_str(), password.data(), password.size()) == 0;
  return is_right && !digest.empty();
}

bool PasswordHasher::is_outdated(const std::string& digest) const {
  return crypto_pwhash_str_needs_rehash(digest.c_str(), options_.cost.passes,
                                        options_.cost.memory) != 0;
}

unsigned PasswordHasher::peak() const {
  const std::lock_guard lock(mutex_);
  return peak_;
}

}  // namespace dripline::identity
