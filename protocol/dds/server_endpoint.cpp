#include <vector>

#include "protocol/dds/configuration.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/cell.hpp"

namespace dripline::dds {
namespace {

/// Passes each message to the cell that its machine is in.
class Server final : public ServerEndpoint {
 public:
  Server(ServerHandlers handlers, const NetworkOptions& options) {
    shared_.handlers = std::move(handlers);
    shared_.cells = options.cells;
    shared_.term = options.term;
  }

  Result<void> start(const NetworkOptions& options) {
    for (std::uint32_t number = 0; number < options.cells; ++number) {
      auto cell = Cell::open(options, number, shared_);
      if (!cell) return fail(cell.error());
      cells_.push_back(std::move(*cell));
    }
    return {};
  }
  Result<void> write(const RecordAck& message) override { return write_to_cell(message); }
  Result<void> write(const Command& message) override { return write_to_cell(message); }
  Result<void> write(const BlockData& message) override { return write_to_cell(message); }
  Result<void> write(const LineRequest& message) override { return write_to_cell(message); }
  void renew_status(const std::string& machine) override {
    cells_[shared_.cell_with(machine)]->renew_status(machine);
  }
  void look_again(const std::string& machine) override {
    for (const auto& cell : cells_) {
      if (takes_machine(machine, cell->number(), shared_.cells)) cell->look_again();
    }
  }
  std::size_t heard_gateways() const override {
    std::size_t count = 0;
    for (const auto& cell : cells_) count += cell->heard_gateways();
    return count;
  }
  Rejected rejected() const override { return shared_.rejections.get(); }

 private:
  template <class Message>
  Result<void> write_to_cell(const Message& message) {
    return cells_[shared_.cell_with(message.machine)]->write(message);
  }

  ServerShared shared_;  // first: the cells use it
  std::vector<std::unique_ptr<Cell>> cells_;
};

}  // namespace

Result<std::unique_ptr<ServerEndpoint>> ServerEndpoint::open(const NetworkOptions& options,
                                                             ServerHandlers handlers) {
  auto server = std::make_unique<Server>(std::move(handlers), options);
  if (auto started = server->start(options); !started) return fail(started.error());
  return server;
}

}  // namespace dripline::dds
