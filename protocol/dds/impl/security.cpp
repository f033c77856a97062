#include "protocol/dds/impl/security.hpp"

#include <filesystem>

namespace dripline::dds {
namespace {

void add_plugin(dds_qos_t* qos, const std::string& service, const std::string& library,
                const std::string& function) {
  const std::string prefix = "dds.sec." + service + ".library.";
  dds_qset_prop(qos, (prefix + "path").c_str(), library.c_str());
  dds_qset_prop(qos, (prefix + "init").c_str(), ("init_" + function).c_str());
  dds_qset_prop(qos, (prefix + "finalize").c_str(), ("finalize_" + function).c_str());
}

Result<void> add_file(dds_qos_t* qos, const char* property, const std::string& file) {
  if (file.empty()) return fail(Errc::Syntax, "DDS security: {} names no file", property);
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    return fail(Errc::NotFound, "DDS security: {}: no file {}", property, file);
  }
  dds_qset_prop(qos, property, ("file:" + file).c_str());
  return {};
}

}  // namespace

Result<void> add_security(const SecurityFiles& files, dds_qos_t* qos) {
  add_plugin(qos, "auth", "dds_security_auth", "authentication");
  add_plugin(qos, "access", "dds_security_ac", "access_control");
  add_plugin(qos, "crypto", "dds_security_crypto", "crypto");
  const std::pair<const char*, const std::string*> properties[] = {
      {"dds.sec.auth.identity_ca", &files.identity_ca},
      {"dds.sec.auth.identity_certificate", &files.certificate},
      {"dds.sec.auth.private_key", &files.private_key},
      {"dds.sec.access.permissions_ca", &files.permissions_ca},
      {"dds.sec.access.governance", &files.governance},
      {"dds.sec.access.permissions", &files.permissions},
  };
  for (const auto& [property, file] : properties) {
    if (auto added = add_file(qos, property, *file); !added) return added;
  }
  if (!files.revocation_list) return {};
  return add_file(qos, "org.eclipse.cyclonedds.sec.auth.crl", *files.revocation_list);
}

}  // namespace dripline::dds
