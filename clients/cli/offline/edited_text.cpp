#include "clients/cli/offline/edited_text.hpp"

#include <algorithm>
#include <filesystem>

#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/lib/byte_source.hpp"
#include "clients/lib/pull.hpp"
#include "clients/lib/push.hpp"

namespace dripline::cli {
namespace {

/// The text is held in memory several times.
constexpr std::uint64_t kMaxBytes = 64 * 1024 * 1024;

/// Text in memory as the source of a push.
class EditedSource final : public client::ByteSource {
 public:
  explicit EditedSource(const std::string& text) : text_(text) {}
  std::uint64_t size() const override { return text_.size(); }
  Result<void> read(std::uint64_t offset, std::span<char> into) override {
    if (offset > text_.size() || into.size() > text_.size() - offset) {
      return fail(Errc::Io, "bytes {} to {} of a text of {}", offset, offset + into.size(),
                  text_.size());
    }
    std::copy_n(text_.data() + offset, into.size(), into.data());
    return {};
  }

 private:
  const std::string& text_;
};

Error too_long(const std::string& name, std::uint64_t size) {
  return {Errc::LimitExceeded,
          fmt::format("{} has {} bytes: at most {} can be edited", name, size, kMaxBytes)};
}

}  // namespace

EditedText::EditedText(Context& context, Place place)
    : context_(context), place_(std::move(place)) {
  is_open_ = place_.file.empty() ? pull() : read_file();
}

const std::string& EditedText::name() const {
  return place_.file.empty() ? place_.program : place_.file;
}

Result<program_editing::EditedProgram> EditedText::edited(
    std::span<const program_editing::BlockChange> changes) const {
  return editor_ == nullptr ? program_editing::edit_lines(text_, changes)
                            : editor_->edit(text_, changes);
}

Result<std::string> EditedText::text_of(std::int64_t first, std::int64_t last) const {
  return editor_ == nullptr ? program_editing::text_of_lines(text_, first, last)
                            : editor_->text_of(text_, first, last);
}

bool EditedText::is_protected() const {
  const auto dialect = interpreter::find_dialect(control_);
  return dialect && (*dialect)->is_protected != nullptr && (*dialect)->is_protected(text_);
}

bool EditedText::use_control(const std::string& control) {
  control_ = control;
  if (control.empty()) return true;
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect) return context_.status = complain(dialect.error()), false;
  editor_ = program_editing::find_program_editor(control);
  return true;
}

bool EditedText::read_file() {
  auto file = MappedFile::open(place_.file);
  if (!file) return context_.status = complain(file.error()), false;
  if (file->text().size() > kMaxBytes) {
    return context_.status = complain(too_long(place_.file, file->text().size())), false;
  }
  text_ = file->text();
  if (!place_.control.empty()) return use_control(place_.control);
  const std::string name = std::filesystem::path(place_.file).filename().string();
  const auto candidates = interpreter::detect_dialect(text_, name);
  return use_control(candidates.size() == 1 ? std::string(candidates.front()->name) : "");
}

bool EditedText::pull() {
  auto client = context_.connect();
  if (!client) return false;
  const auto history = client->program(place_.program);
  if (!history) return context_.status = complain(history.error()), false;
  const auto& program = history->program;
  if (program.held) {
    return context_.status = complain(Error{
               Errc::NotFound, fmt::format("{} has no revision in force: what is there waits for "
                                           "acceptance",
                                           place_.program)}),
           false;
  }
  if (program.size > kMaxBytes) {
    return context_.status = complain(too_long(place_.program, program.size)), false;
  }
  client::PullOptions options{place_.program, program.revision, retry_policy(), {}};
  const auto pulled = client::pull_program(*client, options, [this](std::string_view bytes) {
    text_ += bytes;
    return Result<void>{};
  });
  if (!pulled) return context_.status = complain(pulled.error()), false;
  revision_ = pulled->revision;
  return use_control(place_.control.empty() ? program.control : place_.control);
}

int EditedText::save(const std::string& text, std::string& written) {
  const bool to_file = !place_.file.empty() || !place_.output.empty();
  return to_file ? save_file(text, written) : push(text, written);
}

int EditedText::save_file(const std::string& text, std::string& written) const {
  written = place_.output.empty() ? place_.file : place_.output;
  const auto done = write_file(written, text);
  return done ? kExitOk : complain(done.error());
}

/// Another client may have stored another revision since ours was fetched: that one is not
/// overruled.
int EditedText::push(const std::string& text, std::string& written) {
  auto client = context_.connect();
  if (!client) return context_.status;
  const auto now = client->program(place_.program);
  if (!now) return complain(now.error());
  if (now->program.revision != revision_) {
    complain(Error{Errc::Conflict,
                   fmt::format("{} has revision {} by now, the edit is of revision {}; nothing was "
                               "stored",
                               place_.program, now->program.revision, revision_)});
    return kExitNo;
  }
  EditedSource source(text);
  client::PushOptions options{{.program = place_.program,
                               .control = control_,
                               .comment = place_.comment,
                               .overrides_protection = place_.overrides_protection},
                              retry_policy(),
                              {}};
  const auto pushed = push_program(*client, source, options);
  if (!pushed) return complain(pushed.error());
  written = fmt::format("{} revision {}", place_.program, pushed->revision);
  return kExitOk;
}

}  // namespace dripline::cli
