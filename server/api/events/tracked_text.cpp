#include "server/api/events/tracked_text.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace dripline::api {

namespace {

constexpr std::string_view kName = "\"name\":";
constexpr std::size_t kMaxSize = std::numeric_limits<std::uint32_t>::max();

std::uint32_t place_of(std::size_t at) {
  return static_cast<std::uint32_t>(at);
}

/// The first place from `at` on at which `before` differs from `now` from `at_now` on, or its end.
std::size_t first_difference(std::string_view before, std::string_view now, std::size_t at,
                             std::size_t at_now) {
  constexpr std::size_t kAtOnce = 64;
  const std::size_t end = at + std::min(before.size() - at, now.size() - at_now);
  while (end - at >= kAtOnce && std::memcmp(&before[at], &now[at_now], kAtOnce) == 0) {
    at += kAtOnce;
    at_now += kAtOnce;
  }
  while (at < end && before[at] == now[at_now]) {
    ++at;
    ++at_now;
  }
  return at;
}

}  // namespace

/// Walks through a text. Strict only as far as it must be to stay within the text: what it reads
/// was written by this program.
class TrackedText::Reader {
 public:
  explicit Reader(std::string_view text, std::size_t at = 0) : text_(text), at_(at) {}

  /// The members of the object that the text is, and of the objects in it.
  bool read(std::vector<Member>& members) { return read_object(members, 1) && at_ == text_.size(); }

  std::size_t at() const { return at_; }
  /// A value that is no object or is one within a list.
  bool skip_value() {
    switch (peek()) {
      case '{':
      case '[':
        return skip_nested();
      case '"':
        return skip_string();
      default:
        return skip_word();
    }
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool skip(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  bool read_object(std::vector<Member>& members, std::size_t depth) {
    if (!skip('{')) return false;
    if (skip('}')) return true;
    do {
      if (!read_member(members, depth)) return false;
    } while (skip(','));
    return skip('}');
  }

  bool read_member(std::vector<Member>& members, std::size_t depth) {
    const std::size_t place = members.size();
    members.push_back({.name = place_of(at_), .value = 0, .end = 0, .next = 0, .changed = 0});
    if (!skip_string() || !skip(':')) return false;
    members[place].value = place_of(at_);
    const bool is_good =
        peek() == '{' ? depth < kMaxDepth && read_object(members, depth + 1) : skip_value();
    members[place].end = place_of(at_);
    members[place].next = place_of(members.size());
    return is_good;
  }

  /// A number, true, false or null.
  bool skip_word() {
    const std::size_t begin = at_;
    const auto ends = [](char c) { return c == ',' || c == '}' || c == ']'; };
    while (at_ < text_.size() && !ends(text_[at_])) ++at_;
    return at_ > begin;
  }

  bool skip_nested() {
    std::size_t open = 0;
    do {
      const char c = peek();
      if (c == '"') {
        if (!skip_string()) return false;
        continue;
      }
      if (c == '\0') return false;
      if (c == '{' || c == '[') ++open;
      if (c == '}' || c == ']') --open;
      ++at_;
    } while (open > 0);
    return true;
  }

  bool skip_string() {
    if (!skip('"')) return false;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\')
        ++at_;  // whatever follows is no end
      else if (text_[at_] == '"')
        return skip('"');
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_;
};

void TrackedText::update(std::string text) {
  if (text == text_ || text.size() > kMaxSize) return;
  const std::string before = std::exchange(text_, std::move(text));
  written_after_ = 0;
  ++version_;
  if (!members_.empty() && follow(before)) return;
  members_.clear();
  if (!Reader(text_).read(members_)) members_.clear();
  same_members_since_ = version_;
  for (auto& member : members_) member.changed = version_;
}

/// Moves the members of the text before to where they are now. Only what differs is read again:
/// most of a machine stays as it is, and comparing bytes is a tenth of reading them. False: the
/// members are other ones, or it is not sure that they are the same.
bool TrackedText::follow(std::string_view before) {
  std::size_t differs = first_difference(before, text_, 0, 0);  // in `before`
  std::size_t shift = 0;                                        // modulo its range: it may be back
  std::size_t open[kMaxDepth] = {};
  std::size_t depth = 0;
  const auto close_until = [&](std::size_t place) {
    while (depth > 0 && members_[open[depth - 1]].next <= place) {
      Member& member = members_[open[--depth]];
      member.end = place_of(member.end + shift);
    }
  };
  for (std::size_t i = 0; i < members_.size(); ++i) {
    close_until(i);
    Member& member = members_[i];
    const std::size_t value = member.value, end = member.end;
    if (differs < value) return false;
    member.name = place_of(member.name + shift);
    member.value = place_of(value + shift);
    if (member.next > i + 1) {
      open[depth++] = i;
      continue;
    }
    if (differs <= end) {
      // A number's end is where a longer one continues.
      Reader reader(text_, member.value);
      if (before[value] == '{' || text_[member.value] == '{' || !reader.skip_value()) return false;
      shift = reader.at() - end;
      differs = first_difference(before, text_, end, reader.at());
      if (differs == end) return false;
      member.changed = version_;
      for (std::size_t k = 0; k < depth; ++k) members_[open[k]].changed = version_;
    }
    member.end = place_of(end + shift);
  }
  close_until(members_.size());
  return differs == before.size() && before.size() + shift == text_.size();
}

std::string TrackedText::whole() const {
  std::string out = "{\"version\":" + std::to_string(version_);
  if (text_.size() > 2) out += ',';
  return out.append(text_, 1);
}

const std::string& TrackedText::change_after(std::uint64_t version) {
  if (std::exchange(written_after_, version) == version) return change_;
  change_ = "{\"after\":" + std::to_string(version) + ",\"version\":" + std::to_string(version_);
  for (std::size_t i = 0; i < members_.size(); i = members_[i].next) {
    const Member& member = members_[i];
    const bool is_name = text_.compare(member.name, kName.size(), kName) == 0;
    if (!is_name && member.changed <= version) continue;
    change_ += ',';
    write(change_, i, version);
  }
  change_ += '}';
  return change_;
}

void TrackedText::write(std::string& out, std::size_t place, std::uint64_t since) const {
  const Member& member = members_[place];
  if (member.next == place + 1) {  // it has no members of its own
    out.append(text_, member.name, member.end - member.name);
    return;
  }
  out.append(text_, member.name, member.value - member.name);
  char separator = '{';
  for (std::size_t i = place + 1; i < member.next; i = members_[i].next) {
    if (members_[i].changed <= since) continue;
    out += std::exchange(separator, ',');
    write(out, i, since);
  }
  out += '}';
}

}  // namespace dripline::api
