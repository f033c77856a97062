#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::api {

/// The JSON text of one machine as it is now, and of each of its members the version in which it
/// changed last. What a listener needs that knows some earlier version, however far back, is
/// written from it, once for all who know the same one. Not thread-safe.
class TrackedText {
 public:
  static constexpr std::size_t kMaxDepth = 16;

  /// `text`: an object in one line, without blanks between its parts, as machine_text writes it.
  /// Anything else, and objects nested deeper than kMaxDepth, are always sent whole; texts of 4 GiB
  /// are not taken.
  void update(std::string text);

  const std::string& text() const { return text_; }
  /// 0: there is no text yet. Grows with each update that changes anything.
  std::uint64_t version() const { return version_; }
  /// Since this one the members are the same ones: from there on a change can be sent.
  std::uint64_t same_members_since() const { return same_members_since_; }

  /// The object with its version as the first member, "version".
  std::string whole() const;
  /// Of a version of same_members_since() or later: {"name":...,"after":version,"version":...} and
  /// what has changed since, an object with those of its members that have. To be joined with what
  /// is there: an object member by member, any other value instead of the one there.
  const std::string& change_after(std::uint64_t version);

 private:
  /// `"name":value` in the text.
  struct Member {
    std::uint32_t name, value, end;  ///< where they begin; the value's end
    std::uint32_t next;              ///< the one after it and all that it contains
    std::uint64_t changed;
  };
  class Reader;
  bool follow(std::string_view before);
  void write(std::string& out, std::size_t place, std::uint64_t since) const;

  std::string text_;
  std::vector<Member> members_;
  std::uint64_t version_ = 0, same_members_since_ = 0;
  std::uint64_t written_after_ = 0;  ///< change_ is the one after this version; 0: it is none
  std::string change_;
};

}  // namespace dripline::api
