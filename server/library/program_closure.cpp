#include "server/library/program_closure.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <deque>
#include <set>

#include "gateway/interpreter/core/called_program_names.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::library {
namespace {

using interpreter::ProgramCall;
using interpreter::ProgramIndex;
using interpreter::TextWindow;
using storage::Revision;
using storage::RevisionState;

/// The stored text of one revision; memory is one window.
class StoredText final : public interpreter::ProgramSource {
 public:
  /// `index`: 0 is the program that a run starts, another one a program that it calls.
  StoredText(storage::ProgramStore& programs, const Revision& revision, ProgramIndex index)
      : programs_(programs), revision_(revision), index_(index) {}

  TextWindow fetch(ProgramIndex program, std::uint64_t offset, std::size_t min_bytes) override {
    TextWindow window;
    if (program != index_) return window;
    window.state = TextWindow::State::Ready;
    bytes_.clear();
    if (offset < revision_.size) {
      auto bytes =
          programs_.read_content(revision_.content, offset, std::max(min_bytes, kMaxWindow));
      if (!bytes) {
        window.state = TextWindow::State::Failed;
        window.reason = bytes.error().what;
        return window;
      }
      bytes_ = *std::move(bytes);
    }
    window.text = {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
    window.reaches_end = offset + bytes_.size() >= revision_.size;
    return window;
  }
  interpreter::ProgramLookup find(std::string_view) override {
    return {interpreter::ProgramLookup::State::NotFound, 0};
  }

 private:
  storage::ProgramStore& programs_;
  const Revision& revision_;
  const ProgramIndex index_;
  std::vector<std::byte> bytes_;
};

class Walk {
 public:
  Walk(const storage::Store& store, const ClosureRequest& request,
       interpreter::CallReader read_calls, const interpreter::Setup& setup)
      : store_(store), request_(request), read_calls_(read_calls), setup_(setup) {
    closure_.main = request.main;
    closure_.names_more = !request.named.empty();
  }

  Result<Closure> run() {
    if (auto read = this->read(closure_.main, interpreter::kMainProgram); !read)
      return fail(read.error());
    for (const auto& named : request_.named) {
      if (auto added = add_named(named); !added) return fail(added.error());
    }
    for (; next_ < closure_.called.size(); ++next_) {
      const Revision revision = closure_.called[next_].revision;  // the list grows
      if (is_main(revision)) continue;
      if (auto read = this->read(revision, 1); !read) return fail(read.error());
    }
    return std::move(closure_);
  }

 private:
  bool is_main(const Revision& revision) const {
    return revision.program == closure_.main.program && revision.number == closure_.main.number;
  }
  bool fits(const Revision& revision) const {
    return revision.control.empty() || revision.control == request_.main.control;
  }

  Result<void> read(const Revision& revision, ProgramIndex index) {
    StoredText text(store_.programs, revision, index);
    auto found = read_calls_(setup_, text, index);
    if (!found) {
      return fail(found.error().code, "program {} revision {}: {}", revision.program,
                  revision.number, found.error().what);
    }
    if (index == interpreter::kMainProgram) contained_ = found->contained;
    for (const ProgramCall& call : found->calls) {
      const CallSite site{revision.program, revision.number, call.line};
      if (auto added = add(call, site); !added) return added;
    }
    return {};
  }

  Result<void> add(const ProgramCall& call, const CallSite& site) {
    if (call.name.empty()) {
      closure_.computed.push_back(site);
      return {};
    }
    if (!names_.insert(call.name).second) return {};
    for (const auto& name : {call.earlier, call.name}) {
      // What the started text has itself comes before the library, but after an `earlier` place.
      const bool is_own = name == call.name && !call.is_contained && contained_.contains(name);
      if (is_own) return {};
      if (name.empty()) continue;
      auto revision = find(name);
      if (!revision) return fail(revision.error());
      if (*revision) return add_called({name, std::move(**revision), site});
    }
    if (!call.is_contained) closure_.missing.push_back({call.name, site});
    return {};
  }

  Result<void> add_called(Closure::Called called) {
    const auto is_same = [&](const Closure::Called& other) {
      return other.revision.program == called.revision.program;
    };
    if (std::ranges::any_of(closure_.called, is_same)) return {};
    if (closure_.called.size() >= storage::Decision::kMaxPins) {
      return fail(Errc::LimitExceeded, "program {} revision {} calls more than {} programs",
                  closure_.main.program, closure_.main.number, storage::Decision::kMaxPins);
    }
    closure_.called.push_back(std::move(called));
    return {};
  }

  Result<void> add_named(const ClosureRequest::Named& named) {
    auto revision = store_.programs.revision(named.program, named.revision);
    if (!revision) return fail(revision.error());
    if (!named.revision) {
      auto newest = newest_of(named.program, request_.prefers_released);
      if (!newest) return fail(newest.error());
      if (*newest) *revision = std::move(**newest);
    }
    if (revision->is_held || revision->state == RevisionState::Withdrawn || !fits(*revision)) {
      return fail(Errc::Conflict, "program {} revision {} cannot be called: it is {}",
                  revision->program, revision->number,
                  revision->is_held  ? "pending approval"
                  : !fits(*revision) ? fmt::format("for control {}", revision->control)
                                     : "withdrawn");
    }
    const auto same = std::ranges::find_if(closure_.called, [&](const Closure::Called& called) {
      return called.revision.program == revision->program;
    });
    if (same == closure_.called.end())
      return add_called({named.program, *std::move(revision), std::nullopt});
    same->revision = *std::move(revision);  // another revision than the one that was found
    return {};
  }

  /// The revision that a run would get for a name that a program calls.
  Result<std::optional<Revision>> find(const std::string& name) {
    for (const bool is_released : {true, false}) {
      if (is_released && !request_.prefers_released) continue;
      for (const auto& candidate : interpreter::called_program_names(name)) {
        const auto named =
            std::ranges::find(request_.named, candidate, &ClosureRequest::Named::program);
        if (named != request_.named.end() && named->revision) {
          auto revision = store_.programs.revision(candidate, named->revision);
          if (!revision) return fail(revision.error());
          return std::optional(*std::move(revision));
        }
        auto newest = newest_of(candidate, is_released);
        if (!newest || *newest) return newest;
      }
    }
    return std::optional<Revision>();
  }

  Result<std::optional<Revision>> newest_of(const std::string& program, bool is_released) {
    if (program == closure_.main.program) return std::optional(closure_.main);
    const auto revisions = store_.programs.revisions(program);
    if (!revisions) {
      if (revisions.error().code == Errc::NotFound) return std::optional<Revision>();
      return fail(revisions.error());
    }
    for (const Revision& revision : *revisions) {  // newest first
      const bool has_state = is_released ? revision.state == RevisionState::Released
                                         : revision.state != RevisionState::Withdrawn;
      if (!revision.is_held && has_state && fits(revision)) return std::optional(revision);
    }
    return std::optional<Revision>();
  }

  const storage::Store& store_;
  const ClosureRequest& request_;
  const interpreter::CallReader read_calls_;
  const interpreter::Setup& setup_;
  Closure closure_;
  std::size_t next_ = 0;
  std::set<std::string> names_, contained_;
};

Result<interpreter::Setup> setup_of(const storage::Store& store, const ClosureRequest& request,
                                    const interpreter::Dialect& dialect) {
  if (request.machine.empty()) return interpreter::parse_control_data("", dialect.units);
  const auto stored = store.setups.find(request.machine, std::nullopt);
  if (!stored) return fail(stored.error());
  return interpreter::parse_control_data(stored->text, dialect.units);
}

}  // namespace

Result<Closure> closure_of(const storage::Store& store, const ClosureRequest& request) {
  if (request.main.control.empty()) {
    return fail(Errc::Unsupported, "program {} revision {} has no control: its calls are not known",
                request.main.program, request.main.number);
  }
  const auto dialect = interpreter::find_dialect(request.main.control);
  if (!dialect) return fail(dialect.error());
  const auto read_calls = interpreter::call_reader((*dialect)->name);
  if (read_calls == nullptr) {  // this control calls no other programs
    Closure closure;
    closure.main = request.main;
    return closure;
  }
  const auto setup = setup_of(store, request, **dialect);
  if (!setup) return fail(setup.error());
  return Walk(store, request, read_calls, *setup).run();
}

Result<void> check_whole(const Closure& closure) {
  const auto place = [](const CallSite& site) {
    return fmt::format("line {} of {} revision {}", site.line, site.program, site.revision);
  };
  if (!closure.missing.empty()) {
    std::string names;
    for (const auto& missing : closure.missing) {
      if (!names.empty()) names += ", ";
      names += fmt::format("'{}' ({})", missing.name, place(missing.site));
    }
    return fail(Errc::Conflict, "it calls what is not in the library for control {}: {}",
                closure.main.control, names);
  }
  if (closure.computed.empty() || closure.names_more) return {};
  return fail(Errc::Conflict,
              "{} computes which program it calls: name the programs that may be called",
              place(closure.computed.front()));
}

}  // namespace dripline::library
