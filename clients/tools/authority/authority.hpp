#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "clients/tools/authority/disk.hpp"
#include "clients/tools/authority/ledger.hpp"
#include "clients/tools/authority/signing.hpp"
#include "protocol/base/descriptor.hpp"

namespace dripline::authority {

/// A shop's own authority: it gives the server and each gateway a folder with certificate, key and
/// permissions. One process at a time. Everything it writes appears whole, whenever it is killed:
///
///     FOLDER/authority/      its two keys and what it has issued; stays on this computer
///     FOLDER/server/         for the computer of dncd
///     FOLDER/gateways/NAME/  for the computer of this machine's dncgw
class Authority {
 public:
  static constexpr std::chrono::days kLife{20 * 365};  ///< of the authority itself
  static constexpr int kDefaultDays = 3 * 365;         ///< of the certificates it issues
  static constexpr int kMaxDays = 10 * 365;

  /// Makes its keys. Errors: Conflict (there is one in this folder), Syntax (the shop's name),
  /// Busy, Io.
  static Result<void> create(const std::filesystem::path& folder, const std::string& shop,
                             const Clock& clock);
  /// `clock` must outlive it. Errors: NotFound (no authority there), Corrupt, Denied (others can
  /// read its keys), Busy (another process uses it), Io.
  static Result<Authority> open(const std::filesystem::path& folder, const Clock& clock);

  /// A first certificate, or one after the last was revoked. Errors: Conflict (it has one), Syntax
  /// (the name), LimitExceeded, Io.
  Result<Issued> issue(const Holder& holder, int days);
  /// Another key and certificate in the same folder; the earlier certificate stays valid until it
  /// expires. Errors: NotFound (none was issued), Conflict (it was revoked), Io.
  Result<Issued> renew(const Holder& holder, int days);
  /// Every certificate of the holder. Its folder is removed, and all others get the new list of
  /// revoked ones. May be repeated. Errors: NotFound, Io.
  Result<void> revoke(const Holder& holder);
  /// The newest certificate of every holder, the server first.
  std::vector<Issued> identities() const;

  std::filesystem::path folder_of(const Holder& holder) const;
  /// Whether the holder's folder is there.
  bool has_folder(const Holder& holder) const;
  const std::string& shop() const { return ledger_.shop; }

 private:
  Authority(std::filesystem::path folder, FileLock lock, const Clock& clock)
      : folder_(std::move(folder)), lock_(std::move(lock)), clock_(&clock) {}
  Result<void> load();
  Result<void> save_ledger() const;
  Result<Issued> make(const Holder& holder, int days);
  Result<Files> make_files(const Issued& issued) const;
  Result<void> publish_revoked() const;

  std::filesystem::path folder_;
  FileLock lock_;
  const Clock* clock_;
  Ledger ledger_;
  Signer identities_, permissions_;
  std::string governance_;  ///< signed
  UtcTime ends_;
};

}  // namespace dripline::authority
