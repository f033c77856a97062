#include "gateway/app/serial/upload_store.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/base/durable_file.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

using nlohmann::json;

Error io_error(const std::filesystem::path& path) {
  return {Errc::Io, fmt::format("{}: {}", path.string(), std::strerror(errno))};
}

Descriptor create(const std::filesystem::path& path) {
  constexpr mode_t kOwner = 0600;
  return Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kOwner));
}

Result<void> write_file(const std::filesystem::path& path, const std::string& text) {
  const Descriptor file = create(path);
  if (!file) return fail(io_error(path));
  if (!write_all(file.get(), text)) return fail(io_error(path));
  if (::fsync(file.get()) != 0) return fail(io_error(path));
  return {};
}

std::optional<Upload> parse_note(const std::string& id, std::istream& file) {
  const json note = json::parse(file, nullptr, false);
  if (!note.is_object()) return std::nullopt;
  Upload upload;
  upload.id = id;
  try {
    upload.name = note.at("name").get<std::string>();
    upload.size = note.at("size").get<std::uint64_t>();
    upload.content = note.at("sha256").get<std::string>();
    upload.damage = note.at("damage").get<std::string>();
  } catch (const json::exception&) {
    return std::nullopt;
  }
  return upload;
}

}  // namespace

Result<UploadStore> UploadStore::open(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(Errc::Io, "{}: {}", folder.string(), error.message());
  UploadStore store(folder);
  store.load();
  return store;
}

void UploadStore::load() {
  std::error_code error;
  std::filesystem::remove(open_path(), error);
  std::set<std::string> ids;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    const auto extension = entry.path().extension();
    if (extension == ".json" || extension == ".nc") ids.insert(entry.path().stem().string());
  }
  for (const std::string& id : ids) {
    std::ifstream file(note_path(id));
    if (!file) {  // a kill came before its note
      erase_files(id);
      continue;
    }
    auto upload = parse_note(id, file);
    std::error_code lost;
    const bool is_whole =
        upload && std::filesystem::file_size(text_path(id), lost) == upload->size && !lost;
    if (!is_whole) {
      process::log_error("program {} from the control is damaged on disk and dropped", id);
      erase_files(id);
      continue;
    }
    bytes_ += upload->size;
    waiting_.push_back(*std::move(upload));
  }
}

void UploadStore::begin(const std::string& id) {
  drop();
  open_.emplace();
  open_->id = id;
  if (waiting_.size() >= kMaxUploads) {
    open_->error = Error{Errc::LimitExceeded,
                         fmt::format("{} programs wait for the server already", kMaxUploads)};
    return;
  }
  open_->file = create(open_path());
  if (!open_->file) open_->error = io_error(open_path());
}

void UploadStore::append(const std::string& text) {
  if (!open_ || open_->error) return;
  if (bytes_ + open_->size + text.size() > kMaxBytes) {
    open_->error =
        Error{Errc::LimitExceeded,
              fmt::format("more than {} bytes of programs wait for the server", kMaxBytes)};
    return;
  }
  if (!write_all(open_->file.get(), text)) {
    open_->error = io_error(open_path());
    return;
  }
  open_->hash.update(text);
  open_->size += text.size();
}

void UploadStore::damage(const std::string& how) {
  if (open_ && open_->damage.empty()) open_->damage = how;
}

/// The note comes last: with it the program is there.
Result<Upload> UploadStore::finish(const std::string& name) {
  if (!open_) return fail(Errc::Syntax, "no program was begun");
  if (!open_->error && open_->size == 0) open_->error = Error{Errc::Syntax, "it is empty"};
  if (!open_->error && ::fsync(open_->file.get()) != 0) open_->error = io_error(open_path());
  if (open_->error) {
    const Error error = *open_->error;
    drop();
    return fail(error);
  }
  Upload upload{.id = open_->id,
                .name = name,
                .size = open_->size,
                .content = open_->hash.digest().hex(),
                .damage = open_->damage};
  open_.reset();
  std::error_code error;
  std::filesystem::rename(open_path(), text_path(upload.id), error);
  if (error) return fail(Errc::Io, "{}: {}", text_path(upload.id).string(), error.message());
  const json note{{"name", upload.name},
                  {"size", upload.size},
                  {"sha256", upload.content},
                  {"damage", upload.damage}};
  const auto path = folder_ / "note";
  auto done = write_file(path, note.dump(-1, ' ', false, json::error_handler_t::replace));
  if (!done) return fail(done.error());
  std::filesystem::rename(path, note_path(upload.id), error);
  if (error) return fail(Errc::Io, "{}: {}", note_path(upload.id).string(), error.message());
  if (!sync_folder(folder_)) return fail(io_error(folder_));
  bytes_ += upload.size;
  waiting_.push_back(upload);
  return upload;
}

void UploadStore::drop() {
  if (!open_) return;
  open_.reset();
  std::error_code error;
  std::filesystem::remove(open_path(), error);
}

Result<std::string> UploadStore::read(const std::string& id, std::uint64_t offset,
                                      std::size_t length) const {
  const auto found = std::ranges::find(waiting_, id, &Upload::id);
  if (found == waiting_.end())
    return fail(Errc::NotFound, "there is no program {} from the control", id);
  std::ifstream file(text_path(id), std::ios::binary);
  if (!file) return fail(io_error(text_path(id)));
  std::string text(std::min<std::uint64_t>(length, found->size - std::min(found->size, offset)),
                   '\0');
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(file.gcount()) != text.size()) return fail(io_error(text_path(id)));
  return text;
}

/// The note goes first: without it there is no program.
void UploadStore::erase_files(const std::string& id) const {
  std::error_code error;
  std::filesystem::remove(note_path(id), error);
  std::filesystem::remove(text_path(id), error);
}

/// Only what is there: an id from the network makes no path.
void UploadStore::remove(const std::string& id) {
  const auto found = std::ranges::find(waiting_, id, &Upload::id);
  if (found == waiting_.end()) return;
  erase_files(id);
  bytes_ -= found->size;
  waiting_.erase(found);
}

}  // namespace dripline::gateway
