#include "protocol/base/name_lookup.hpp"

#include <netdb.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <system_error>
#include <thread>

#include "protocol/base/descriptor.hpp"

namespace dripline {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Result<AddressList> ask_system(const std::string& host, const char* port, int flags) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = flags;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host.c_str(), port, &wanted, &found);
  if (failed != 0) return fail(Errc::NotFound, "no address: {}", ::gai_strerror(failed));
  return AddressList(found, &::freeaddrinfo);
}

Result<HostAddresses> texts_of(const Result<AddressList>& list) {
  if (!list) return fail(list.error());
  HostAddresses all;
  for (const addrinfo* one = list->get(); one != nullptr; one = one->ai_next) {
    std::array<char, NI_MAXHOST> text{};
    if (::getnameinfo(one->ai_addr, one->ai_addrlen, text.data(), text.size(), nullptr, 0,
                      NI_NUMERICHOST) == 0)
      all.emplace_back(text.data());
  }
  if (all.empty()) return fail(Errc::NotFound, "no address");
  return all;
}

/// The lookups that are in progress. Nothing destroys it: a thread may end after main.
class LookupCount {
 public:
  bool enter() {
    if (number_.fetch_add(1) < PendingLookup::kMax) return true;
    --number_;
    return false;
  }
  void leave() { --number_; }

 private:
  std::atomic<int> number_ = 0;
};

constinit LookupCount lookups_in_progress;

}  // namespace

/// What the thread of a lookup owns, with the one that waits for it.
struct PendingLookup::State {
  std::mutex mutex;
  std::condition_variable_any is_done;
  std::optional<Result<HostAddresses>> found;
  Descriptor signal{::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)};

  void set(Result<HostAddresses> result) {
    {
      const std::lock_guard lock(mutex);
      found = std::move(result);
    }
    is_done.notify_all();
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(signal.get(), &one, sizeof one);
  }
};

Result<PendingLookup> PendingLookup::begin(const std::string& host, const NameLookup& lookup) {
  auto state = std::make_shared<State>();
  if (auto numeric = texts_of(ask_system(host, nullptr, AI_NUMERICHOST))) {
    state->set(std::move(numeric));
    return PendingLookup(std::move(state));
  }
  const auto too_many = fail(Errc::LimitExceeded, "{} names are looked up already", kMax);
  if (!lookups_in_progress.enter()) return too_many;
  try {
    std::thread([state, host, lookup] {
      state->set(lookup(host));
      lookups_in_progress.leave();
    }).detach();
  } catch (const std::system_error&) {
    lookups_in_progress.leave();
    return too_many;
  }
  return PendingLookup(std::move(state));
}

std::optional<Result<HostAddresses>> PendingLookup::result() const {
  const std::lock_guard lock(state_->mutex);
  return state_->found;
}

Result<HostAddresses> PendingLookup::wait(SteadyTime end, const std::stop_token& stop) const {
  std::unique_lock lock(state_->mutex);
  state_->is_done.wait_until(lock, stop, end, [this] { return state_->found.has_value(); });
  if (!state_->found) return fail(Errc::Timeout, "the name server does not answer in time");
  return *state_->found;
}

int PendingLookup::descriptor() const {
  return state_->signal.get();
}

Result<HostAddresses> look_up(const std::string& host) {
  return texts_of(ask_system(host, nullptr, 0));
}

Result<HostAddresses> addresses_of(const std::string& host, const NameLookup& lookup,
                                   SteadyTime end, const std::stop_token& stop) {
  const auto pending = PendingLookup::begin(host, lookup);
  if (!pending) return fail(pending.error());
  return pending->wait(end, stop);
}

Result<SocketAddress> socket_address(const std::string& address, std::uint16_t port) {
  const auto list =
      ask_system(address, std::to_string(port).c_str(), AI_NUMERICHOST | AI_NUMERICSERV);
  if (!list || (*list)->ai_addrlen > sizeof(sockaddr_storage))
    return fail(Errc::Syntax, "'{}' is no address", address);
  SocketAddress made;
  std::memcpy(&made.bytes, (*list)->ai_addr, (*list)->ai_addrlen);
  made.size = (*list)->ai_addrlen;
  return made;
}

}  // namespace dripline
