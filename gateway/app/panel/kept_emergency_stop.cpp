#include "gateway/app/panel/kept_emergency_stop.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/durable_file.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

/// All of one length: the file keeps its size, and its block on the disk.
constexpr std::pair<EmergencyStop, std::string_view> kStopTexts[] = {
    {EmergencyStop::Released, "released          \n"},
    {EmergencyStop::PressedFromNetwork, "pressed, network  \n"},
    {EmergencyStop::PressedAtPanel, "pressed, panel    \n"}};

/// A file that is missing or empty was never written: its writer was not answered.
EmergencyStop read_stop(const std::filesystem::path& file) {
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!open && errno == ENOENT) return EmergencyStop::Released;
  std::array<char, 64> bytes{};
  const ssize_t count = open ? ::read(open.get(), bytes.data(), bytes.size()) : -1;
  if (count == 0) return EmergencyStop::Released;
  const std::string_view found(bytes.data(), count < 0 ? 0 : static_cast<std::size_t>(count));
  for (const auto& [state, text] : kStopTexts)
    if (text == found) return state;
  process::log_error("{} cannot be read: the emergency stop is taken for pressed at the panel",
                     file.string());
  return EmergencyStop::PressedAtPanel;
}

}  // namespace

KeptEmergencyStop::KeptEmergencyStop(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  state_ = read_stop(file_);
  if (is_pressed())
    process::log_warning("the emergency stop is pressed ({}), as before the gateway's start",
                         is_pressed_at_panel() ? "at the panel" : "from the network");
  const auto done = write();
  is_on_disk_ = done.has_value();
  if (!done) process::log_warning("the emergency stop cannot be kept: {}", done.error().what);
}

Result<void> KeptEmergencyStop::press(bool is_at_panel) {
  return keep(is_at_panel || is_pressed_at_panel() ? EmergencyStop::PressedAtPanel
                                                   : EmergencyStop::PressedFromNetwork);
}

Result<void> KeptEmergencyStop::keep(EmergencyStop state) {
  const bool is_same = std::exchange(state_, state) == state;
  if (file_.empty() || (is_same && is_on_disk_)) return {};
  auto done = write();
  is_on_disk_ = done.has_value();
  if (!done) process::log_error("the emergency stop cannot be kept: {}", done.error().what);
  return done;
}

Result<void> KeptEmergencyStop::write() const {
  std::string_view text;
  for (const auto& [state, its_text] : kStopTexts)
    if (state == state_) text = its_text;
  const Descriptor file(::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR));
  const bool is_done = file && write_all(file.get(), text) && ::fsync(file.get()) == 0 &&
                       sync_folder(file_.parent_path());
  if (is_done) return {};
  return fail(Errc::Io, "{}: {}", file_.string(), std::generic_category().message(errno));
}

std::string answer_of_press(const Result<void>& kept) {
  if (kept) return {};
  return fmt::format(
      "pressed and in force, but it does not outlive the gateway, which cannot keep it: {}",
      kept.error().what);
}

std::string answer_of_release(const Result<void>& kept) {
  if (kept) return {};
  return fmt::format(
      "released, but the gateway's next start begins with it pressed: it cannot be kept: {}",
      kept.error().what);
}

}  // namespace dripline::gateway
