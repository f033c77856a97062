#include "server/api/tracked_text.hpp"

#include <algorithm>
#include <utility>

namespace dripline::api {

namespace {

constexpr std::string_view kName = "\"name\":";

}  // namespace

/// Finds the members of an object and of the objects in it, and compares them with those of the
/// text before. Strict only as far as it must be to stay within the text: what it reads was written
/// by this program.
class TrackedText::Reader {
 public:
  struct Before {
    std::string_view text;
    const std::vector<Member>& members;
  };
  Reader(std::string_view text, std::vector<Member>& members, const Before& before,
         std::uint64_t version)
      : text_(text), members_(members), before_(before), version_(version) {}

  bool read() { return read_object(1) && at_ == text_.size(); }
  /// Whether both texts have the same members, and an object where the other one has one.
  bool are_same() const { return are_same_ && members_.size() == before_.members.size(); }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool skip(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  bool read_object(std::size_t depth) {
    if (!skip('{')) return false;
    if (skip('}')) return true;
    do {
      if (!read_member(depth)) return false;
    } while (skip(','));
    return skip('}');
  }

  bool read_member(std::size_t depth) {
    const std::size_t place = members_.size();
    members_.push_back({.name = at_, .value = 0, .end = 0, .next = 0, .changed = 0});
    if (!skip_string() || !skip(':')) return false;
    members_[place].value = at_;
    const bool is_good = peek() == '{' ? depth < kMaxDepth && read_object(depth + 1) : skip_value();
    members_[place].end = at_;
    members_[place].next = members_.size();
    if (is_good) compare(place);
    return is_good;
  }

  void compare(std::size_t place) {
    Member& now = members_[place];
    now.changed = version_;
    if (place >= before_.members.size()) are_same_ = false;
    if (!are_same_) return;
    const Member& before = before_.members[place];
    const bool is_object = text_[now.value] == '{';
    const bool was_object = before_.text[before.value] == '{';
    are_same_ = before.next == now.next && is_object == was_object &&
                part(text_, now.name, now.value) == part(before_.text, before.name, before.value);
    if (now.next > place + 1) {
      now.changed = 0;
      for (std::size_t i = place + 1; i < now.next; i = members_[i].next)
        now.changed = std::max(now.changed, members_[i].changed);
    } else if (part(text_, now.value, now.end) == part(before_.text, before.value, before.end)) {
      now.changed = before.changed;
    }
  }

  static std::string_view part(std::string_view text, std::size_t begin, std::size_t end) {
    return text.substr(begin, end - begin);
  }

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
  std::vector<Member>& members_;
  const Before before_;
  const std::uint64_t version_;
  std::size_t at_ = 0;
  bool are_same_ = true;
};

void TrackedText::update(std::string text) {
  if (text == text_) return;
  const std::string before = std::exchange(text_, std::move(text));
  members_.swap(earlier_);
  members_.clear();
  written_after_ = 0;
  ++version_;
  Reader reader(text_, members_, {.text = before, .members = earlier_}, version_);
  if (!reader.read()) members_.clear();
  if (!members_.empty() && reader.are_same()) return;
  same_members_since_ = version_;
  for (auto& member : members_) member.changed = version_;
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
