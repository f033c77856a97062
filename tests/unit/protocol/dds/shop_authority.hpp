#pragma once

#include "clients/tools/authority/authority.hpp"
#include "protocol/dds/security_folder.hpp"
#include "protocol/pki/identity_files.hpp"
#include "tests/support/temporary_folder.hpp"

/// An authority with folders for a server and gateways, as `dnc pki` makes them.
namespace dripline::dds::test {

class ShopAuthority {
 public:
  ShopAuthority() {
    auto made = authority::Authority::create(folder_.path() / "pki", "shop", clock_);
    if (made) opened_.emplace(authority::Authority::open(folder_.path() / "pki", clock_).value());
  }
  authority::Authority& operator*() { return *opened_; }
  authority::Authority* operator->() { return &*opened_; }

  static authority::Holder gateway(const std::string& machine) {
    return {authority::Role::Gateway, machine};
  }
  /// Made at the first call.
  std::filesystem::path folder(const authority::Holder& holder) {
    if (!opened_->has_folder(holder)) (void)opened_->issue(holder, 10).value();
    return opened_->folder_of(holder);
  }
  SecurityFiles server() { return files(folder(authority::the_server())); }
  SecurityFiles gateway_files(const std::string& machine) {
    return files(folder(gateway(machine)));
  }
  /// Of any folder, whatever is in it.
  static SecurityFiles files(const std::filesystem::path& folder) {
    const auto file = [&](const char* name) { return (folder / name).string(); };
    return {.identity_ca = file(pki::kIdentityAuthorityFile),
            .certificate = file(pki::kCertificateFile),
            .private_key = file(pki::kKeyFile),
            .permissions_ca = file(pki::kPermissionsAuthorityFile),
            .governance = file(pki::kGovernanceFile),
            .permissions = file(pki::kPermissionsFile),
            .revocation_list = file(pki::kRevokedFile)};
  }
  /// The two keys of the authority, for what it would never sign itself.
  authority::Signer identities() const {
    return signer(pki::kIdentityAuthorityFile, "identity_ca.key");
  }
  authority::Signer permissions() const {
    return signer(pki::kPermissionsAuthorityFile, "permissions_ca.key");
  }
  const std::filesystem::path& path() const { return folder_.path(); }
  const Clock& clock() const { return clock_; }

 private:
  authority::Signer signer(const char* certificate, const char* key) const {
    const auto own = folder_.path() / "pki" / "authority";
    return {pki::read_file((own / certificate).string()).value(),
            pki::read_file((own / key).string()).value()};
  }
  test_support::TemporaryFolder folder_;
  SystemClock clock_;
  std::optional<authority::Authority> opened_;
};

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  (void)authority::replace_file(file, {text, authority::Secrecy::OwnerAlone});
}
inline std::string text_of(const std::filesystem::path& file) {
  return pki::read_file(file.string()).value();
}

}  // namespace dripline::dds::test
