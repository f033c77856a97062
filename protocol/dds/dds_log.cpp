#include "protocol/dds/dds_log.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>

namespace dripline::dds {
namespace {

using Receiver = void (*)(bool is_error, std::string_view text);

void pass_on(void* userdata, const dds_log_data_t* entry) {
  std::string_view text(entry->message, entry->size);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
  constexpr std::uint32_t kErrors = DDS_LC_FATAL | DDS_LC_ERROR;
  reinterpret_cast<Receiver>(userdata)((entry->priority & kErrors) != 0, text);
}

}  // namespace

void send_log_to(Receiver to) {
  dds_set_log_sink(pass_on, reinterpret_cast<void*>(to));
  dds_set_trace_sink(pass_on, reinterpret_cast<void*>(to));
}

}  // namespace dripline::dds
