#include "server/library/setups.hpp"

#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"

namespace dripline::library {

namespace {

storage::SetupRevision revision_of(const SetupText& text, const storage::Actor& who) {
  storage::SetupRevision setup;
  setup.machine = text.machine;
  setup.text = text.text;
  setup.comment = text.comment;
  setup.author = who.name;
  return setup;
}

}  // namespace

Result<void> Setups::check(const SetupText& text) const {
  if (text.comment.size() > kMaxComment) {
    return fail(Errc::LimitExceeded, "a comment of {} bytes, at most {}", text.comment.size(),
                kMaxComment);
  }
  if (text.text.size() > storage::kMaxSetup) {
    return fail(Errc::LimitExceeded, "a setup of {} bytes, at most {}", text.text.size(),
                storage::kMaxSetup);
  }
  if (auto good = catalog_.check_setup(text.control, text.text); !good) {
    return fail(with_control_words(good.error(), text.control, Refusal::BadParameters));
  }
  return {};
}

void Setups::announce(const storage::SetupRevision& saved, const SetupText& text) const {
  auto announced = saved;
  announced.text = text.text;
  for (const auto& notify : on_saved_) notify(announced, text.control);
}

Result<SavedSetup> Setups::save(const SetupText& text, const storage::Actor& who) {
  if (auto good = check(text); !good) return fail(good.error());
  const auto before = store_.find(text.machine, std::nullopt);
  auto saved = store_.save(revision_of(text, who), text.base);
  if (!saved) return fail(saved.error());
  const bool is_unchanged = before && before->number == saved->number;
  if (!is_unchanged) {
    audit_.write({.who = who,
                  .action = "setup.save",
                  .subject = text.machine,
                  .detail = fmt::format("setup {}: {} bytes, sha256 {}", saved->number, saved->size,
                                        saved->sha256.hex())});
    announce(*saved, text);
  }
  return SavedSetup{*std::move(saved), is_unchanged};
}

Result<storage::SetupRevision> Setups::save_by(const SetupText& text, const storage::Actor& who,
                                               const Keep& keep) {
  if (auto good = check(text); !good) return fail(good.error());
  auto saved = keep(revision_of(text, who));
  if (saved) announce(*saved, text);
  return saved;
}

Result<storage::LoadedSetup> Setups::note_loaded(const std::string& machine,
                                                 std::optional<std::uint64_t> number,
                                                 const storage::Actor& who) {
  auto loaded = store_.note_loaded(machine, number, who);
  if (!loaded) return loaded;
  process::log_info("setup machine={}: {} is in the control by={}", machine,
                    number ? fmt::format("{}", *number) : "which one is not known, that", who.name);
  return loaded;
}

}  // namespace dripline::library
