// A machine in the midst of a program, and a board that sends anything. Properties: the lines that
// are sent are those of the program, each once and in order; no block is executed whose line was
// not answered; after an alarm no line is sent; nothing leaves a hold by itself.
#include <cstdint>
#include <span>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/fuzz/gateway/lines_in_pieces.hpp"
#include "tests/support/manual_clock.hpp"

namespace {

using namespace dripline;
using namespace dripline::machine;
using fuzz::require;

class Sink final : public ExecutionSink {
 public:
  bool is_alarmed = false;
  void on_alarm(const interpreter::Alarm&) override { is_alarmed = true; }
};

class Board {
 public:
  Board() {
    machine.line_opened();
    hear("\r\nGrbl 1.1f ['$' for help]\r\n");
    hear("[VER:1.1f:]\r\n[OPT:VNM,15,128]\r\nok\r\n");
    hear(
        "$10=3\r\n$13=0\r\n$20=0\r\n$22=0\r\n$30=1000\r\n$100=80\r\n$101=80\r\n$110=6000\r\n"
        "$111=6000\r\n$120=500\r\n$121=500\r\n$130=300\r\n$131=300\r\nok\r\n");
    hear("[G54:0.000,0.000]\r\nok\r\n");
    hear("<Idle|MPos:0.000,0.000|Bf:15,128|FS:0,0>\r\n");
    lines.clear();
    require(machine.check_begin({}).has_value());
    machine.begin({});
    interpreter::Position to;
    for (int i = 1; i <= 30; ++i) {
      interpreter::Origin origin;
      origin.block = static_cast<std::uint64_t>(i);
      to.set(interpreter::Axis::X, Length::mm(i));
      machine.events().on_line({origin, to, Feed::per_minute(Length::mm(600)), false});
      machine.events().on_block_end(origin);
    }
  }
  void hear(std::string_view text) {
    clock->advance(std::chrono::milliseconds(20));
    const grbl::BoardOutput output = machine.exchange(std::as_bytes(std::span(text)));
    real_time += output.real_time;
    lines += output.lines;
  }

  std::shared_ptr<test_support::ManualClock> clock = std::make_shared<test_support::ManualClock>();
  Sink sink;
  grbl::GrblMachine machine{{.sink = sink, .clock = clock}};
  std::string lines, real_time;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  Board board;
  std::size_t answers = 0;
  for (std::size_t i = 0; i <= size; i += 24) {
    const std::string piece = text.substr(i, 24);
    (void)board.machine.poll(Seconds{0.02}, 512);
    const bool was_alarmed = board.sink.is_alarmed;
    const std::size_t before = board.lines.size();
    board.hear(piece);
    require(!was_alarmed || board.lines.size() == before);
    for (const char c : piece) answers += c == '\n' ? 1 : 0;  // no more than that
    require(board.machine.status().executed <= answers);
  }
  require(board.real_time.find('~') == std::string::npos);
  // The preamble and the question for the modes, then the program.
  const std::string_view sent = board.lines;
  std::size_t at = sent.find("$G\n");
  for (int i = 1; at != std::string_view::npos && i <= 30; ++i) {
    const std::string wanted = "N" + std::to_string(i + 2) + "G1X" + std::to_string(i);
    const std::size_t next = sent.find("\nN", at);
    if (next == std::string_view::npos) break;
    require(sent.substr(next + 1).starts_with(wanted));
    at = next + 1;
  }
  return 0;
}
