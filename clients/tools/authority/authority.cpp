#include "clients/tools/authority/authority.hpp"

#include <sys/stat.h>
#include <algorithm>
#include <map>

#include "clients/tools/authority/access_documents.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/private_folder.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/pki/identity_files.hpp"

namespace dripline::authority {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentityKey = "identity_ca.key";
constexpr const char* kPermissionsKey = "permissions_ca.key";
constexpr const char* kLedger = "issued.json";

fs::path own_folder(const fs::path& folder) {
  return folder / "authority";
}

UtcTime whole_seconds(UtcTime time) {
  return std::chrono::floor<std::chrono::seconds>(time);
}

Result<FileLock> lock(const fs::path& folder) {
  return FileLock::acquire(folder / "lock", fmt::format("the authority in {}", folder.string()));
}

/// The key and the certificate of one of the two authorities.
Result<Signer> make_signer(Purpose purpose, const std::string& shop, const std::string& name,
                           const Validity& validity) {
  auto key = make_key();
  if (!key) return fail(key.error());
  auto certificate = make_root({.purpose = purpose,
                                .shop = shop,
                                .unit = "authority",
                                .name = name,
                                .serial = new_serial(),
                                .validity = validity},
                               *key);
  if (!certificate) return fail(certificate.error());
  return Signer{*std::move(certificate), *std::move(key)};
}

Result<Files> make_authority(const std::string& shop, UtcTime now) {
  const Validity validity{whole_seconds(now - kClockTolerance),
                          whole_seconds(now + Authority::kLife)};
  const auto identities = make_signer(Purpose::IdentityAuthority, shop, "identities", validity);
  if (!identities) return fail(identities.error());
  const auto permissions =
      make_signer(Purpose::PermissionsAuthority, shop, "permissions", validity);
  if (!permissions) return fail(permissions.error());
  auto governance = sign_document(governance_document(), *permissions);
  if (!governance) return fail(governance.error());
  return Files{{pki::kIdentityAuthorityFile, {identities->certificate}},
               {kIdentityKey, {identities->key, Secrecy::OwnerAlone}},
               {pki::kPermissionsAuthorityFile, {permissions->certificate}},
               {kPermissionsKey, {permissions->key, Secrecy::OwnerAlone}},
               {pki::kGovernanceFile, {*std::move(governance)}},
               {kLedger, {write_ledger({.shop = shop, .issued = {}})}}};
}

Result<std::string> read_secret(const fs::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) == 0 && (facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return fail(Errc::Denied, "'{}' can be read by others: chmod 600 it", file.string());
  return pki::read_file(file.string());
}

Result<void> check_holder(const Holder& holder) {
  if (holder.role == Role::Gateway) return check_machine_name(holder.name);
  if (holder.name == kServerName) return {};
  return fail(Errc::Syntax, "the server's identity is named {}", kServerName);
}

}  // namespace

std::string_view to_string(Role role) {
  return role == Role::Server ? pki::kServerUnit : pki::kGatewayUnit;
}

Result<void> check_shop_name(std::string_view name) {
  constexpr std::size_t kMaxShop = 64;  // of an organization in a certificate
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (name.size() > kMaxShop) {
    return fail(Errc::LimitExceeded, "name of the shop: {} characters, at most {}", name.size(),
                kMaxShop);
  }
  const bool is_good = !name.empty() && is_letter(name.front()) && is_letter(name.back()) &&
                       std::ranges::all_of(name, [&](char c) {
                         return is_letter(c) || std::string_view(" ._-").find(c) != name.npos;
                       });
  if (is_good) return {};
  return fail(Errc::Syntax,
              "name of the shop '{}': use letters, digits, blanks, . _ and -, beginning and ending "
              "with a letter or digit",
              name);
}

Result<void> Authority::create(const fs::path& folder, const std::string& shop,
                               const Clock& clock) {
  if (auto checked = check_shop_name(shop); !checked) return checked;
  if (auto made = make_private_folder(folder, {"authority"}); !made) return fail(made.error());
  const auto locked = lock(folder);
  if (!locked) return fail(locked.error());
  std::error_code ec;
  if (fs::exists(own_folder(folder), ec))
    return fail(Errc::Conflict, "there is an authority in '{}'", folder.string());
  const auto files = make_authority(shop, clock.now());
  if (!files) return fail(files.error());
  return replace_folder(own_folder(folder), *files);
}

Result<Authority> Authority::open(const fs::path& folder, const Clock& clock) {
  std::error_code ec;
  if (!fs::exists(own_folder(folder), ec)) {
    return fail(Errc::NotFound, "there is no authority in '{}': make one with dnc pki init",
                folder.string());
  }
  auto locked = lock(folder);
  if (!locked) return fail(locked.error());
  Authority authority(folder, *std::move(locked), clock);
  if (auto loaded = authority.load(); !loaded) return fail(loaded.error());
  return authority;
}

Result<void> Authority::load() {
  const auto own = own_folder(folder_);
  const auto read = [&](std::string& to, const char* name, auto reader) -> Result<void> {
    auto text = reader(own / name);
    if (!text) return fail(text.error());
    to = *std::move(text);
    return {};
  };
  const auto open_file = [](const fs::path& file) { return pki::read_file(file.string()); };
  std::string ledger;
  if (auto r = read(identities_.certificate, pki::kIdentityAuthorityFile, open_file); !r) return r;
  if (auto r = read(identities_.key, kIdentityKey, read_secret); !r) return r;
  if (auto r = read(permissions_.certificate, pki::kPermissionsAuthorityFile, open_file); !r)
    return r;
  if (auto r = read(permissions_.key, kPermissionsKey, read_secret); !r) return r;
  if (auto r = read(governance_, pki::kGovernanceFile, open_file); !r) return r;
  if (auto r = read(ledger, kLedger, open_file); !r) return r;
  auto parsed = parse_ledger(ledger);
  if (!parsed) return fail(parsed.error());
  ledger_ = *std::move(parsed);
  const auto root = pki::parse_certificate(identities_.certificate);
  if (!root) return fail(root.error());
  ends_ = root->not_after;
  return {};
}

fs::path Authority::folder_of(const Holder& holder) const {
  return holder.role == Role::Server ? folder_ / "server" : folder_ / "gateways" / holder.name;
}

bool Authority::has_folder(const Holder& holder) const {
  std::error_code ec;
  return fs::exists(folder_of(holder), ec);
}

Result<void> Authority::save_ledger() const {
  return replace_file(own_folder(folder_) / kLedger, {write_ledger(ledger_)});
}

Result<Issued> Authority::issue(const Holder& holder, int days) {
  if (auto checked = check_holder(holder); !checked) return fail(checked.error());
  const Issued* const newest = ledger_.newest(holder);
  // Without the folder, a process was killed between ledger and folder.
  if (newest != nullptr && !newest->revoked && has_folder(holder)) {
    return fail(Errc::Conflict, "{} '{}' has a certificate: renew or revoke it",
                to_string(holder.role), holder.name);
  }
  return make(holder, days);
}

Result<Issued> Authority::renew(const Holder& holder, int days) {
  const Issued* const newest = ledger_.newest(holder);
  if (newest == nullptr) {
    return fail(Errc::NotFound, "no certificate of {} '{}' was issued", to_string(holder.role),
                holder.name);
  }
  if (newest->revoked) {
    return fail(Errc::Conflict, "the certificate of {} '{}' was revoked: issue another one",
                to_string(holder.role), holder.name);
  }
  return make(holder, days);
}

/// The ledger first: a certificate that is not in it could never be revoked.
Result<Issued> Authority::make(const Holder& holder, int days) {
  if (days < 1 || days > kMaxDays)
    return fail(Errc::LimitExceeded, "{} days, 1 to {}", days, kMaxDays);
  const UtcTime now = clock_->now();
  if (now >= ends_) return fail(Errc::Denied, "the authority has expired: make another one");
  const Issued issued{.holder = holder,
                      .serial = new_serial(),
                      .validity = {whole_seconds(now - kClockTolerance),
                                   std::min(whole_seconds(now + std::chrono::days(days)), ends_)}};
  ledger_.issued.push_back(issued);
  if (auto saved = save_ledger(); !saved) return fail(saved.error());
  const auto files = make_files(issued);
  if (!files) return fail(files.error());
  const auto folder = folder_of(holder);
  if (auto made = make_private_subfolder(folder.parent_path()); !made) return fail(made.error());
  if (auto written = replace_folder(folder, *files); !written) return fail(written.error());
  return issued;
}

Result<Files> Authority::make_files(const Issued& issued) const {
  auto key = make_key();
  if (!key) return fail(key.error());
  auto certificate = make_certificate({.purpose = Purpose::Identity,
                                       .shop = ledger_.shop,
                                       .unit = std::string(to_string(issued.holder.role)),
                                       .name = issued.holder.name,
                                       .serial = issued.serial,
                                       .validity = issued.validity},
                                      *key, identities_);
  if (!certificate) return fail(certificate.error());
  const auto parsed = pki::parse_certificate(*certificate);
  if (!parsed) return fail(parsed.error());
  auto permissions = sign_document(
      permissions_document(issued.holder, parsed->subject, issued.validity), permissions_);
  if (!permissions) return fail(permissions.error());
  auto revoked = make_revocation_list(ledger_.issued, identities_, clock_->now());
  if (!revoked) return fail(revoked.error());
  return Files{{pki::kIdentityAuthorityFile, {identities_.certificate}},
               {pki::kPermissionsAuthorityFile, {permissions_.certificate}},
               {pki::kCertificateFile, {*std::move(certificate)}},
               {pki::kKeyFile, {*std::move(key), Secrecy::OwnerAlone}},
               {pki::kPermissionsFile, {*std::move(permissions)}},
               {pki::kGovernanceFile, {governance_}},
               {pki::kRevokedFile, {*std::move(revoked)}}};
}

Result<void> Authority::revoke(const Holder& holder) {
  if (ledger_.newest(holder) == nullptr) {
    return fail(Errc::NotFound, "no certificate of {} '{}' was issued", to_string(holder.role),
                holder.name);
  }
  if (ledger_.revoke(holder, clock_->now())) {
    if (auto saved = save_ledger(); !saved) return saved;
  }
  if (auto removed = remove_folder(folder_of(holder)); !removed) return removed;
  return publish_revoked();
}

Result<void> Authority::publish_revoked() const {
  const auto list = make_revocation_list(ledger_.issued, identities_, clock_->now());
  if (!list) return fail(list.error());
  for (const auto& each : identities()) {
    if (!has_folder(each.holder)) continue;
    auto written = replace_file(folder_of(each.holder) / pki::kRevokedFile, {*list});
    if (!written) return written;
  }
  return {};
}

std::vector<Issued> Authority::identities() const {
  std::map<Holder, Issued> newest;
  for (const auto& each : ledger_.issued) newest.insert_or_assign(each.holder, each);
  std::vector<Issued> list;
  for (auto& [holder, issued] : newest) list.push_back(std::move(issued));
  return list;
}

}  // namespace dripline::authority
