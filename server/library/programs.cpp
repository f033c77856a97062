#include "server/library/programs.hpp"

#include <algorithm>

#include "protocol/base/names.hpp"
#include "protocol/base/utf8.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"

namespace dripline::library {
namespace {

/// More unfinished uploads than this are still possible; their checks are repeated when needed.
constexpr std::size_t kMaxSessions = 256;
constexpr std::uint64_t kCatchUpPiece = 1024 * 1024;

Result<void> check_field(std::string_view name, const std::optional<std::string>& value) {
  if (!value) return {};
  if (value->size() > storage::kMaxField) {
    return fail(Errc::LimitExceeded, "{} of {} bytes: at most {}", name, value->size(),
                storage::kMaxField);
  }
  for (std::string_view rest = *value; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    if (length == 0) return fail(Errc::Syntax, "{} is not UTF-8", name);
    if (static_cast<unsigned char>(rest[0]) < 0x20 || rest[0] == 0x7F)
      return fail(Errc::Syntax, "{} '{}' has a control character", name, one_line(*value));
    rest.remove_prefix(length);
  }
  return {};
}

}  // namespace

Result<void> check_fields(const storage::FieldChange& change) {
  for (const auto& [name, value] :
       {std::pair("part", &change.part), std::pair("operation", &change.operation),
        std::pair("material", &change.material), std::pair("machine group", &change.machine_group),
        std::pair("CAM file", &change.cam_file)}) {
    if (auto good = check_field(name, *value); !good) return good;
  }
  return {};
}

Programs::Programs(const storage::Store& store, const Clock& clock, const ControlCatalog& catalog,
                   AuditTrail& audit)
    : store_(store.programs),
      uploads_(store.uploads),
      clock_(clock),
      catalog_(catalog),
      audit_(audit),
      titles_(store.programs) {}

Result<storage::Upload> Programs::begin(const UploadRequest& request, const storage::Actor& who) {
  if (auto name = check_program_name(request.program); !name) return fail(name.error());
  if (request.comment.size() > kMaxComment) {
    return fail(Errc::LimitExceeded, "comment of {} bytes: at most {}", request.comment.size(),
                kMaxComment);
  }
  if (!request.control.empty()) {
    if (auto known = check_control(catalog_, request.control); !known) return fail(known.error());
  }
  if (auto good = check_fields(request.change); !good) return fail(good.error());
  storage::Upload upload;
  upload.program = request.program;
  upload.control = request.control;
  upload.comment = request.comment;
  upload.author = who.name;
  upload.created = clock_.now();
  upload.is_held = request.is_held;
  upload.change = request.change;
  upload.folder_file = request.folder_file;
  return uploads_.begin(upload);
}

Result<storage::Upload> Programs::upload(const std::string& id, const storage::Actor& who) {
  auto upload = uploads_.find(id);
  if (upload && upload->author != who.name)
    return fail(Errc::NotFound, "upload '{}' is not one of {}", id, who.name);
  return upload;
}

Result<storage::Upload> Programs::append(const std::string& id, std::uint64_t offset,
                                         std::span<const std::byte> bytes) {
  const auto session = this->session(id);
  const std::lock_guard lock(session->mutex);
  if (!session->upload) {
    auto known = uploads_.find(id);
    if (!known) return drop_session(id), fail(known.error());
    session->upload = *std::move(known);
  }
  // An attachment may have any bytes.
  if (session->upload->attachment) return drop_session(id), uploads_.append(id, offset, bytes);
  // Only a piece that begins where the upload ends is new; the store judges all others.
  const bool is_new = offset == session->upload->received;
  if (is_new) {
    if (auto caught_up = catch_up(*session, *session->upload); !caught_up) {
      return fail(caught_up.error());
    }
  }
  ContentCheck check = session->check;
  if (is_new) {
    if (auto good = check.feed(bytes); !good) return drop(*session->upload, good.error());
  }
  auto upload = uploads_.append(id, offset, bytes);
  if (!upload) {
    session->upload.reset();  // the next piece begins from what is stored
    return fail(upload.error());
  }
  session->check = check;
  session->upload = *upload;
  if (upload->control.empty() && upload->received >= kHead) {
    if (auto known = determine_control(*session->upload); !known) return fail(known.error());
  }
  return *session->upload;
}

Result<Committed> Programs::commit(const std::string& id, const std::optional<Digest>& expected,
                                   const storage::Actor& who, Protection protection) {
  const auto session = this->session(id);
  const std::lock_guard lock(session->mutex);
  auto upload = uploads_.find(id);
  if (!upload) return drop_session(id), fail(upload.error());
  if (upload->attachment) {
    drop_session(id);
    return fail(Errc::Conflict, "upload {} is of attachment '{}'", id, *upload->attachment);
  }
  if (auto caught_up = catch_up(*session, *upload); !caught_up) return fail(caught_up.error());
  if (auto good = session->check.finish(); !good) return drop(*upload, good.error());
  if (upload->control.empty()) {
    if (auto known = determine_control(*upload); !known) return fail(known.error());
  }
  if (protection == Protection::Respect && !upload->is_held) {
    if (auto free = check_protection(upload->program, expected); !free) {
      return drop(*upload, free.error());
    }
  }
  const auto before = store_.revisions(upload->program);
  auto revision = uploads_.commit(id, expected);
  if (!revision) return fail(revision.error());
  drop_session(id);
  // Numbers only grow: a revision at or below the newest one existed before.
  const bool is_unchanged = before && revision->number <= before->front().number;
  if (!is_unchanged) {
    process::log_info("stored program={} revision={} size={} control={} held={}", revision->program,
                      revision->number, revision->size, revision->control, revision->is_held);
    audit_.write({.who = who,
                  .action = "program.store",
                  .subject = revision->program,
                  .detail = fmt::format("revision {} sha256 {} size {}{}", revision->number,
                                        revision->content.hex(), revision->size,
                                        revision->is_held ? " held" : "")});
    if (revision->is_held && on_held_) on_held_(*revision);
  }
  return Committed{.revision = *std::move(revision), .is_unchanged = is_unchanged};
}

Result<void> Programs::describe(const storage::Description& description) {
  if (auto good = check_fields(description.change); !good) return good;
  return store_.describe(description);
}

Result<void> Programs::abandon(const std::string& id) {
  const auto session = this->session(id);
  const std::lock_guard lock(session->mutex);
  drop_session(id);
  return uploads_.abandon(id);
}

Result<storage::Revision> Programs::accept(const std::string& program, std::uint64_t number,
                                           const storage::Actor& who) {
  auto accepted = store_.accept(program, number, who);
  if (accepted)
    process::log_info("accepted program={} revision={} by={}", program, number, who.name);
  return accepted;
}

Result<void> Programs::reject(const std::string& program, std::uint64_t number,
                              const storage::Actor& who) {
  auto rejected = store_.reject(program, number, who);
  if (rejected)
    process::log_info("rejected program={} revision={} by={}", program, number, who.name);
  return rejected;
}

/// A program with the content that is to replace it may stay.
Result<void> Programs::check_protection(const std::string& program,
                                        const std::optional<Digest>& replacement) {
  const auto revision = store_.revision(program, std::nullopt);
  if (!revision) return {};  // nothing in force
  if (replacement && *replacement == revision->content) return {};
  const auto head = store_.read_content(revision->content, 0, std::min(revision->size, kHead));
  if (!head) return fail(head.error());
  const std::string_view text(reinterpret_cast<const char*>(head->data()), head->size());
  if (!catalog_.is_protected(revision->control, text)) return {};
  return fail(Errc::Conflict,
              "revision {} is protected against change and erasure; force overrides that",
              revision->number);
}

Result<void> Programs::remove(const std::string& program, const storage::Actor& who,
                              Protection protection) {
  if (protection == Protection::Respect) {
    if (auto free = check_protection(program, std::nullopt); !free) {
      return fail(free.error().code, "program '{}' stays: {}", program, free.error().what);
    }
  }
  if (auto removed = store_.remove(program); !removed) return removed;
  process::log_info("removed program={}", program);
  audit_.write({.who = who, .action = "program.remove", .subject = program, .detail = {}});
  return {};
}

/// A refused copy or rename, in the words of the control that the program is for.
Error Programs::in_control_words(const storage::ProgramMove& move, const Error& error) {
  const auto source = store_.revisions(move.from);
  if (!source || error.code == Errc::Io || error.code == Errc::Busy) return error;
  auto refusal = Refusal::None;
  if (move.from == move.to) {
    refusal = Refusal::OntoItself;
  } else if (error.code == Errc::Syntax || error.code == Errc::LimitExceeded) {
    refusal = Refusal::BadNumber;
  } else if (error.code == Errc::Conflict && store_.revisions(move.to)) {
    refusal = Refusal::NameTaken;
  }
  return with_control_words(error, source->front().control, refusal);
}

Result<storage::Revision> Programs::copy(const storage::ProgramMove& move,
                                         std::optional<std::uint64_t> number) {
  auto copy = store_.copy(move, number);
  if (!copy) return fail(in_control_words(move, copy.error()));
  process::log_info("copied program={} to={} by={}", move.from, move.to, move.who.name);
  return copy;
}

Result<void> Programs::rename(const storage::ProgramMove& move) {
  auto renamed = store_.rename(move);
  if (!renamed) return fail(in_control_words(move, renamed.error()));
  process::log_info("renamed program={} to={} by={}", move.from, move.to, move.who.name);
  return renamed;
}

std::shared_ptr<Programs::Session> Programs::session(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (const auto found = sessions_.find(id); found != sessions_.end()) return found->second;
  if (sessions_.size() >= kMaxSessions) {
    // An idle one; its check can be repeated from the stored bytes.
    const auto idle =
        std::ranges::find_if(sessions_, [](const auto& s) { return s.second.use_count() == 1; });
    if (idle != sessions_.end()) sessions_.erase(idle);
  }
  return sessions_.emplace(id, std::make_shared<Session>()).first->second;
}

void Programs::drop_session(const std::string& id) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(id);
}

/// After a restart of the server the check has seen nothing of the bytes received before.
Result<void> Programs::catch_up(Session& session, const storage::Upload& upload) {
  if (session.check.offset() > upload.received) session.check = ContentCheck{};
  while (session.check.offset() < upload.received) {
    const std::uint64_t missing = upload.received - session.check.offset();
    auto bytes = uploads_.read(upload.id, session.check.offset(), std::min(missing, kCatchUpPiece));
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) {
      return fail(Errc::Corrupt, "upload {} has {} bytes but they end at {}", upload.id,
                  upload.received, session.check.offset());
    }
    if (auto good = session.check.feed(*bytes); !good) return drop(upload, good.error());
  }
  return {};
}

Result<void> Programs::determine_control(storage::Upload& upload) {
  const auto head = uploads_.read(upload.id, 0, kHead);
  if (!head) return fail(head.error());
  const std::string_view text(reinterpret_cast<const char*>(head->data()), head->size());
  auto control = detect_control(catalog_, text, upload.program);
  // What a program is for does not change by a text that looks otherwise.
  const auto latest = store_.revision(upload.program, std::nullopt);
  if (latest && !latest->control.empty()) {
    if (control && *control != latest->control) {
      return drop(upload,
                  {Errc::Unsupported,
                   fmt::format("its revision {} is for control {}, this text looks like one "
                               "for {}: name the control",
                               latest->number, latest->control, *control)});
    }
    control = latest->control;
  }
  if (!control) return drop(upload, control.error());
  if (auto set = uploads_.set_control(upload.id, *control); !set) return set;
  upload.control = *std::move(control);
  return {};
}

tl::unexpected<Error> Programs::drop(const storage::Upload& upload, const Error& error) {
  drop_session(upload.id);
  if (auto dropped = uploads_.abandon(upload.id); !dropped) {
    process::log_warning("upload {} of program={} could not be dropped: {}", upload.id,
                         upload.program, dropped.error().what);
  }
  process::log_info("refused upload of program={}: {}", upload.program, error.what);
  return fail(error.code, "program '{}' is refused: {}; nothing was changed", upload.program,
              error.what);
}

}  // namespace dripline::library
