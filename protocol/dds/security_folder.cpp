#include "protocol/dds/security_folder.hpp"

#include <sys/stat.h>
#include <optional>

#include "protocol/pki/identity_files.hpp"
#include "protocol/pki/verification.hpp"

namespace dripline::dds {
namespace {

namespace fs = std::filesystem;

/// The texts of the files; they are small.
struct Texts {
  std::string identity_authority, permissions_authority, certificate, key, permissions, governance;
  std::optional<std::string> revoked;
};

/// Adds the file to an error that does not name it.
tl::unexpected<Error> wrong(const std::string& file, const Error& error) {
  return fail(error.code, "DDS security: '{}': {}", file, error.what);
}

Result<Texts> read_texts(const SecurityFiles& files) {
  Texts texts;
  const std::pair<const std::string*, std::string*> all[] = {
      {&files.identity_ca, &texts.identity_authority},
      {&files.permissions_ca, &texts.permissions_authority},
      {&files.certificate, &texts.certificate},
      {&files.private_key, &texts.key},
      {&files.permissions, &texts.permissions},
      {&files.governance, &texts.governance},
  };
  for (const auto& [file, text] : all) {
    auto read = pki::read_file(*file);
    if (!read) return fail(read.error().code, "DDS security: {}", read.error().what);
    *text = *std::move(read);
  }
  if (!files.revocation_list) return texts;
  auto read = pki::read_file(*files.revocation_list);
  if (!read) return fail(read.error().code, "DDS security: {}", read.error().what);
  texts.revoked = *std::move(read);
  return texts;
}

Result<void> check_secrecy(const std::string& key) {
  struct stat facts {};
  constexpr mode_t kOthers = S_IRWXO | S_IWGRP | S_IXGRP;
  if (::stat(key.c_str(), &facts) != 0 || (facts.st_mode & kOthers) == 0) return {};
  return fail(Errc::Denied,
              "DDS security: '{}': others can read the private key (mode {:o}): chmod 600 it", key,
              facts.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO));
}

/// Permissions name their holder by the subject of the certificate.
bool is_granted_to(const std::string& permissions, const std::string& subject) {
  return permissions.find("<subject_name>" + subject + "</subject_name>") != std::string::npos;
}

Result<void> check_documents(const SecurityFiles& files, const Texts& texts,
                             const pki::Certificate& certificate) {
  const auto governance = pki::open_document(texts.governance, texts.permissions_authority);
  if (!governance) return wrong(files.governance, governance.error());
  const auto permissions = pki::open_document(texts.permissions, texts.permissions_authority);
  if (!permissions) return wrong(files.permissions, permissions.error());
  if (is_granted_to(*permissions, certificate.subject)) return {};
  return fail(Errc::Denied, "DDS security: '{}': it has no permissions for {}", files.permissions,
              certificate.subject);
}

Result<void> check_validity(const SecurityFiles& files, const pki::Certificate& certificate,
                            UtcTime now) {
  if (now >= certificate.not_after) {
    return fail(Errc::Denied, "DDS security: '{}': the certificate has expired {}",
                files.certificate, pki::expiry_text(certificate.not_after, now));
  }
  if (now >= certificate.not_before) return {};
  return fail(Errc::Denied,
              "DDS security: '{}': the certificate is not valid before {}; is the clock right?",
              files.certificate, to_iso8601(certificate.not_before));
}

/// Certificates of other tools may lack the unit.
Result<void> check_holder(const SecurityFiles& files, const pki::Certificate& certificate,
                          const SecurityHolder& holder) {
  const bool is_server = holder.role == Role::Server;
  const auto other = is_server ? pki::kGatewayUnit : pki::kServerUnit;
  if (certificate.unit == other) {
    return fail(Errc::Denied, "DDS security: '{}': it is the certificate of a {} ({}), not of a {}",
                files.certificate, other, certificate.subject, is_server ? "server" : "gateway");
  }
  if (is_server || certificate.common_name == holder.machine) return {};
  return fail(Errc::Denied,
              "DDS security: '{}': it is the certificate of '{}', not of machine '{}'",
              files.certificate, certificate.common_name, holder.machine);
}

SecurityFiles files_of(const fs::path& folder) {
  const auto file = [&](const char* name) { return fs::absolute(folder / name).string(); };
  SecurityFiles files{.identity_ca = file(pki::kIdentityAuthorityFile),
                      .certificate = file(pki::kCertificateFile),
                      .private_key = file(pki::kKeyFile),
                      .permissions_ca = file(pki::kPermissionsAuthorityFile),
                      .governance = file(pki::kGovernanceFile),
                      .permissions = file(pki::kPermissionsFile),
                      .revocation_list = std::nullopt};
  std::error_code ec;
  if (fs::exists(folder / pki::kRevokedFile, ec)) files.revocation_list = file(pki::kRevokedFile);
  return files;
}

}  // namespace

Result<SecurityFolder> open_security_folder(const fs::path& folder, const SecurityHolder& holder,
                                            UtcTime now) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec))
    return fail(Errc::NotFound, "DDS security: '{}' is no folder", folder.string());
  SecurityFolder result{.files = files_of(folder), .certificate = {}};
  const SecurityFiles& files = result.files;
  const auto texts = read_texts(files);
  if (!texts) return fail(texts.error());
  if (auto secret = check_secrecy(files.private_key); !secret) return fail(secret.error());
  auto certificate = pki::parse_certificate(texts->certificate);
  if (!certificate) return wrong(files.certificate, certificate.error());
  if (auto good = check_holder(files, *certificate, holder); !good) return fail(good.error());
  if (auto good = check_validity(files, *certificate, now); !good) return fail(good.error());
  if (auto fits = pki::check_key(texts->certificate, texts->key); !fits)
    return wrong(files.private_key, fits.error());
  const auto is_issued = pki::check_issue({.certificate = texts->certificate,
                                           .authority = texts->identity_authority,
                                           .revocation_list = texts->revoked},
                                          now);
  if (!is_issued) return wrong(files.certificate, is_issued.error());
  if (auto good = check_documents(files, *texts, *certificate); !good) return fail(good.error());
  result.certificate = *std::move(certificate);
  return result;
}

}  // namespace dripline::dds
