// The calls of Client for the audit trail.
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

Reply<AuditState> Client::verify_audit() {
  return fetch<AuditState>(impl::with_method("POST", impl::path_of("audit") + "/verification"));
}

Reply<void> Client::export_audit(const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = impl::get(impl::path_of("audit") + "/export");
  request.on_body = sink;
  return perform(request);
}

Reply<void> Client::run_attestation(std::string_view id,
                                    const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = impl::get(impl::path_of("runs", id) + "/attestation");
  request.on_body = sink;
  return perform(request);
}

}  // namespace dripline::client
