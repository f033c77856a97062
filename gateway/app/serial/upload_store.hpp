#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// A program that the control has sent, until the server has stored it.
struct Upload {
  std::string id;    ///< "1700000000000000-1"
  std::string name;  ///< as a rule or the protocol gives it; may be empty
  std::uint64_t size = 0;
  std::string content;  ///< SHA-256, hexadecimal
  std::string damage;   ///< why part of it is not to be trusted; empty: it is whole
};

/// One that is coming in. (Of UploadStore alone.)
struct OpenUpload {
  std::string id, damage;
  std::uint64_t size = 0;
  Sha256 hash;
  std::optional<Error> error;
  Descriptor file;
};

/// Programs from the control on the gateway's disk: each is there when it is complete, and stays
/// until the server has it. One thread. Bounds: kMaxUploads and kMaxBytes; more is refused.
class UploadStore {
 public:
  static constexpr std::size_t kMaxUploads = 64;
  static constexpr std::uint64_t kMaxBytes = 256ULL * 1024 * 1024;

  /// Finds what an earlier process has left; what it had begun is dropped. Errors: Io.
  static Result<UploadStore> open(const std::filesystem::path& folder);

  /// A program begins; one that was begun is dropped.
  void begin(const std::string& id);
  void append(const std::string& text);
  void damage(const std::string& how);
  /// Errors: LimitExceeded, Io, Syntax (it is empty); it is dropped then.
  Result<Upload> finish(const std::string& name);
  void drop();

  const std::deque<Upload>& waiting() const { return waiting_; }
  /// At most `length` bytes. Errors: NotFound, Io.
  Result<std::string> read(const std::string& id, std::uint64_t offset, std::size_t length) const;
  /// The server has it. Nothing happens when there is none.
  void remove(const std::string& id);

 private:
  explicit UploadStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path text_path(const std::string& id) const { return folder_ / (id + ".nc"); }
  std::filesystem::path note_path(const std::string& id) const { return folder_ / (id + ".json"); }
  std::filesystem::path open_path() const { return folder_ / "begun"; }
  void load();
  void erase_files(const std::string& id) const;

  std::filesystem::path folder_;
  std::deque<Upload> waiting_;
  std::uint64_t bytes_ = 0;
  std::optional<OpenUpload> open_;
};

}  // namespace dripline::gateway
