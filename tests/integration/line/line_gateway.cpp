#include "tests/integration/line/line_gateway.hpp"

#include <gtest/gtest.h>
#include <csignal>
#include <fstream>
#include <sstream>

#include "gateway/report/outbox.hpp"
#include "tests/integration/system.hpp"

namespace dripline::integration {

using test_support::eventually;

LineGateway::LineGateway(Options options) : options_(std::move(options)) {
  start();
}

LineGateway::~LineGateway() {
  if (testing::Test::HasFailure()) std::fprintf(stderr, "%s\n", log().c_str());
}

void LineGateway::start() {
  std::vector<std::string> command{program_path("dncgw"),
                                   "--machine",
                                   "lathe-1",
                                   "--control",
                                   options_.control,
                                   "--state",
                                   folder_.path() / "gw",
                                   "--server",
                                   "none",
                                   "--line",
                                   options_.address,
                                   "--speed",
                                   options_.speed,
                                   "--log",
                                   folder_.path() / "log"};
  if (options_.is_unattended) {
    command.push_back("--unattended");
    command.push_back("yes");
  }
  for (const std::string& setting : options_.settings) {
    command.push_back("--line-setting");
    command.push_back(setting);
  }
  command.insert(command.end(), options_.arguments.begin(), options_.arguments.end());
  gateway_.emplace(command, folder_.path() / "output");
  EXPECT_TRUE(wait_logged("is open")) << gateway_->output();
}

void LineGateway::restart(bool is_killed) {
  const std::size_t opened = logged("is open");
  if (is_killed) {
    gateway_->kill();
  } else {
    gateway_->signal(SIGTERM);
    EXPECT_EQ(gateway_->wait(), 0) << log();
  }
  gateway_.reset();
  start();
  EXPECT_TRUE(wait_logged("is open", opened + 1)) << log();
}

std::string LineGateway::log() const {
  std::ifstream file(folder_.path() / "log", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::size_t LineGateway::logged(std::string_view text) const {
  const std::string all = log();
  std::size_t times = 0;
  for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1))
    ++times;
  return times;
}

std::size_t LineGateway::runs_ended() const {
  return logged("run ended");
}

bool LineGateway::wait_ended(std::size_t runs, std::chrono::milliseconds limit) const {
  return eventually([&] { return runs_ended() >= runs; }, limit);
}

bool LineGateway::wait_logged(std::string_view text, std::size_t times) const {
  return eventually([&] { return logged(text) >= times; });
}

const std::vector<dds::Record>& LineGateway::records() {
  if (records_) return *records_;
  gateway_->signal(SIGTERM);
  EXPECT_EQ(gateway_->wait(), 0) << log();
  auto outbox = report::Outbox::open(folder_.path() / "gw" / "outbox.sqlite");
  EXPECT_TRUE(outbox);
  records_ = *outbox->read("lathe-1", 0, 100'000);
  return *records_;
}

std::vector<dds::RunEndText> LineGateway::endings() {
  std::vector<dds::RunEndText> endings;
  for (const dds::Record& record : records()) {
    if (record.kind != dds::RecordKind::RunEnded) continue;
    const auto text = dds::decode_run_end(record.text);
    EXPECT_TRUE(text);
    endings.push_back(*text);
  }
  return endings;
}

std::vector<std::string> LineGateway::outputs() {
  std::vector<std::string> lines;
  for (const dds::Record& record : records()) {
    if (record.kind == dds::RecordKind::Output) lines.push_back(record.text);
  }
  return lines;
}

}  // namespace dripline::integration
