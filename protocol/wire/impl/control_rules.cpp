#include "protocol/wire/impl/control_rules.hpp"

namespace dripline::wire {
namespace {

/// Alarms of the reader/punch interface.
class FanucRules final : public ControlRules {
 public:
  std::optional<Error> fault(LineFault fault) const override {
    return Error{Errc::Corrupt, fmt::format("alarm 085: {}", fault_text(fault))};
  }
  std::optional<Error> overrun(unsigned limit) const override {
    return Error{Errc::LimitExceeded,
                 fmt::format("alarm 087: more than {} characters came after DC3", limit)};
  }
  std::optional<Error> not_ready() const override {
    return Error{Errc::Io, "alarm 086: the other end's DR is off"};
  }
};

}  // namespace

std::string_view fault_text(LineFault fault) {
  constexpr std::string_view kTexts[] = {"parity error", "framing error", "overrun error", "break"};
  return kTexts[static_cast<std::size_t>(fault)];
}

std::unique_ptr<ControlRules> make_rules(const LineSettings& settings, Role role) {
  if (role == Role::Host) return std::make_unique<ControlRules>();
  switch (settings.control.kind) {
    case ControlKind::Plain:
      break;
    case ControlKind::Fanuc:
      return std::make_unique<FanucRules>();
    case ControlKind::ProtoTrak:
      return make_prototrak_rules();
    case ControlKind::Centurion:
      return make_centurion_rules(settings.control);
  }
  return std::make_unique<ControlRules>();
}

}  // namespace dripline::wire
