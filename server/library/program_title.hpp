#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "protocol/base/digest.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::library {

/// How much of a program is searched for its title.
inline constexpr std::size_t kTitleHead = 1024;
inline constexpr std::size_t kMaxTitle = 64;

/// The name of a program in its first block, as menus of controls show it: the comment beside
/// its O number, or alone on a line in front of the block or right after it; the name after a
/// TNC's `BEGIN PGM`; without those, the first block itself. At most kMaxTitle bytes of whole
/// characters; empty: nothing. Pure.
std::string program_title(std::string_view head);

/// Titles of stored contents. Content never changes, so each is read once; the last 16384 are
/// remembered. Any thread; the store must outlive it.
class ProgramTitles {
 public:
  explicit ProgramTitles(storage::ProgramStore& store) : store_(store) {}
  /// Empty also when the content cannot be read: reading all of it returns the error.
  std::string of(const Digest& content);

 private:
  static constexpr std::size_t kMaxKnown = 16384;
  storage::ProgramStore& store_;
  std::mutex mutex_;
  std::map<Digest, std::string> known_;
  std::deque<Digest> order_;  ///< in which they came
};

}  // namespace dripline::library
