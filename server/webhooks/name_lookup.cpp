#include "server/webhooks/name_lookup.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <array>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

namespace dripline::webhooks {
namespace {

using Addresses = std::vector<std::string>;

Result<Addresses> ask_system(const std::string& host, int flags) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = flags;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host.c_str(), nullptr, &wanted, &found);
  if (failed != 0) return fail(Errc::Timeout, "no address: {}", ::gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  Addresses all;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    std::array<char, NI_MAXHOST> text{};
    if (::getnameinfo(one->ai_addr, one->ai_addrlen, text.data(), text.size(), nullptr, 0,
                      NI_NUMERICHOST) == 0)
      all.emplace_back(text.data());
  }
  if (all.empty()) return fail(Errc::Timeout, "no address");
  return all;
}

/// What the thread of a lookup owns, with the one that waits for it.
struct Pending {
  std::mutex mutex;
  std::condition_variable_any is_done;
  std::optional<Result<Addresses>> found;
};

/// The lookups that are in progress. Nothing destroys it: a thread may end after main.
class Count {
 public:
  bool enter() {
    if (number_.fetch_add(1) < kMaxLookups) return true;
    --number_;
    return false;
  }
  void leave() { --number_; }

 private:
  std::atomic<int> number_ = 0;
};

constinit Count lookups_in_progress;

bool begin(const std::shared_ptr<Pending>& pending, const std::string& host,
           const NameLookup& lookup) {
  if (!lookups_in_progress.enter()) return false;
  try {
    std::thread([pending, host, lookup] {
      auto found = lookup(host);
      {
        const std::lock_guard lock(pending->mutex);
        pending->found = std::move(found);
      }
      pending->is_done.notify_all();
      lookups_in_progress.leave();
    }).detach();
  } catch (const std::system_error&) {
    lookups_in_progress.leave();
    return false;
  }
  return true;
}

}  // namespace

Result<Addresses> look_up(const std::string& host) {
  return ask_system(host, 0);
}

Result<Addresses> addresses_of(const std::string& host, const NameLookup& lookup, SteadyTime end,
                               const std::stop_token& stop) {
  if (auto numeric = ask_system(host, AI_NUMERICHOST)) return numeric;
  const auto pending = std::make_shared<Pending>();
  if (!begin(pending, host, lookup))
    return fail(Errc::LimitExceeded, "{} names are looked up already", kMaxLookups);
  std::unique_lock lock(pending->mutex);
  pending->is_done.wait_until(lock, stop, end, [&] { return pending->found.has_value(); });
  if (!pending->found) return fail(Errc::Timeout, "the name server does not answer in time");
  return *std::move(pending->found);
}

}  // namespace dripline::webhooks
