// The bodies of jobs and webhooks, URLs of webhooks, and the list of revoked certificates.
// Properties: what is taken is within its bounds, and a refusal has a text.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/run_bodies.hpp"
#include "server/api/bodies/webhook_bodies.hpp"
#include "server/identity/revoked_certificates.hpp"
#include "server/library/job_queue.hpp"
#include "server/webhooks/delivery.hpp"

namespace {

template <class T>
void must_explain(const dripline::Result<T>& read) {
  if (!read && read.error().what.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const auto job = api::decode_job(body);
  must_explain(job);
  if (job && !check_program_name(job->job.program)) std::abort();
  if (job && job->job.comment.size() > library::JobQueue::kMaxText) std::abort();
  must_explain(api::decode_job_move(body));
  must_explain(api::decode_job_start(body));
  const auto webhook = api::decode_webhook(body);
  must_explain(webhook);
  const auto url = webhooks::check_url(body);
  must_explain(url);
  if (url && !body.starts_with("http://") && !body.starts_with("https://")) std::abort();
  const auto revoked = identity::parse_revoked(body);
  must_explain(revoked);
  if (!revoked) return 0;
  for (const auto& serial : *revoked) {
    if (serial.size() % 2 != 0 || serial.size() > 40) std::abort();
  }
  return 0;
}
