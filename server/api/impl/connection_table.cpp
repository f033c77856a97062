#include "server/api/impl/connection_table.hpp"

namespace dripline::api {

ConnectionTable::Admission ConnectionTable::admit(const std::string& address) {
  Admission admission;
  const auto found = addresses_.find(address);
  const bool is_address_full =
      found != addresses_.end() && found->second.seats >= limits_.per_address;
  if (is_address_full) {
    admission.evicted =
        evict([&](const Entry& entry) { return !entry.is_reserve && entry.address == address; });
  } else if (seats_ >= limits_.connections) {
    admission.evicted = evict([](const Entry& entry) { return !entry.is_reserve; });
  }
  admission.is_reserve = !admission.evicted && (is_address_full || seats_ >= limits_.connections);
  if (admission.is_reserve && reserved_ >= limits_.reserve) {
    admission.evicted = evict([](const Entry& entry) { return entry.is_reserve; });
  }
  admission.id = ++last_id_;
  const Entry entry{.address = address,
                    .state = State::Opening,
                    .is_reserve = admission.is_reserve,
                    .since = ++ticks_};
  entries_.emplace(admission.id, entry);
  if (entry.is_reserve) {
    ++reserved_;
  } else {
    ++seats_;
    ++counts_of(entry).seats;
  }
  return admission;
}

template <class Condition>
std::optional<ConnectionTable::Id> ConnectionTable::evict(Condition may_go) {
  auto chosen = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    const Entry& candidate = entry->second;
    const bool is_silent = candidate.state == State::Opening || candidate.state == State::Idle;
    if (!is_silent || !may_go(candidate)) continue;
    const auto rank = [](const Entry& e) { return std::pair(e.state, e.since); };
    if (chosen == entries_.end() || rank(candidate) < rank(chosen->second)) chosen = entry;
  }
  if (chosen == entries_.end()) return std::nullopt;
  const Id id = chosen->first;
  erase(chosen);
  return id;
}

std::optional<ConnectionTable::Id> ConnectionTable::evict_any() {
  return evict([](const Entry&) { return true; });
}

void ConnectionTable::set(Id id, State state) {
  const auto entry = entries_.find(id);
  if (entry != entries_.end()) change(entry->second, state);
}

bool ConnectionTable::begin_request(Id id, bool may_be_stop) {
  const auto entry = entries_.find(id);
  if (entry == entries_.end()) return false;
  const std::size_t free = may_be_stop ? (limits_.reserve + 3) / 4 : (limits_.reserve + 1) / 2;
  if (entry->second.is_reserve && busy_reserve_ + free >= limits_.reserve) return false;
  change(entry->second, State::Busy);
  return true;
}

void ConnectionTable::change(Entry& entry, State state) {
  if (entry.is_reserve && entry.state == State::Busy) --busy_reserve_;
  if (entry.is_reserve && state == State::Busy) ++busy_reserve_;
  entry.state = state;
  entry.since = ++ticks_;
}

bool ConnectionTable::begin_stream(Id id) {
  const auto entry = entries_.find(id);
  if (entry == entries_.end() || entry->second.is_reserve) return false;
  Counts& counts = counts_of(entry->second);
  if (streams_ >= limits_.streams || counts.streams >= limits_.streams_per_address) return false;
  ++streams_;
  ++counts.streams;
  entry->second.state = State::Streaming;
  return true;
}

void ConnectionTable::leave(Id id) {
  if (const auto entry = entries_.find(id); entry != entries_.end()) erase(entry);
}

void ConnectionTable::erase(Entries::iterator entry) {
  if (entry->second.is_reserve) {
    --reserved_;
    if (entry->second.state == State::Busy) --busy_reserve_;
  } else {
    Counts& counts = counts_of(entry->second);
    --seats_;
    --counts.seats;
    if (entry->second.state == State::Streaming) {
      --streams_;
      --counts.streams;
    }
    if (counts.seats == 0) addresses_.erase(entry->second.address);
  }
  entries_.erase(entry);
}

}  // namespace dripline::api
