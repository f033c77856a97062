#include "tests/support/dialect_programs.hpp"

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/machine/simulated_machine.hpp"

namespace dripline::test_support {

using interpreter::Axis;
using interpreter::StepState;

const std::vector<DialectProgram>& dialect_programs() {
  static const std::vector<DialectProgram> kPrograms{
      {"centurion", "O0101",
       "G21 G98\n"
       "G0 X10 Z2\n"
       "G1 X20 Z-5 F1200\n"
       "G2 X30 Z-10 R5 F900\n"
       "G1 X30.5 Z-22.125\n"
       "G3 X20 Z-30 R12\n"
       "G4 P0.1\n"
       "G0 X0 Z0\n"
       "M30\n"},
      {"fanuc", "O0102",
       "%\nO0102\n"
       "G21 G90 G94 G17 G00 X40. Y0\n"
       "G02 X0 Y-40. I-40. F2400\n"
       "G02 J20.\n"
       "G03 X20. Y-20. Z6. J20.\n"
       "G91 G01 X-3.125 Y1.25 Z-0.5 F1500\n"
       "X-3.125 Y1.25\n"
       "G90 G04 P100\n"
       "G00 X0 Y0 Z0\n"
       "M30\n%\n"},
      {"prototrak-plus", "PN103",
       "PN103 G20 ;\n"
       "N1 G100 X.5A Y.25A T1 ;\n"
       "N2 G101 XB.5A YB.25A XE1.A YE.5A F800 CR0 ;\n"
       "N3 G103 XB1.A YB.5A XE.5A YE1.A XC.5A YC.5A F800 CR- ;\n"
       "N4 G100 X0A Y0A ;\n"
       "%\n"},
      {"rs274ngc", "path",
       "G21 G90 G17 G94 F1800\n"
       "G0 X5 Y0 Z1\n"
       "G2 X5 Y0 I-5 J0\n"
       "G3 X0 Y5 Z-2 I-5 J0\n"
       "#1=4\n"
       "G1 X[#1*0.5] Y[5-#1*0.3]\n"
       "G1 X[#1*1.0625] Y[5-#1*#1*0.3]\n"
       "G18 G3 X4.25 Z-4 I0 K-1\n"
       "G17 G0 X0 Y0 Z0\n"
       "M2\n"},
      {"tektronix-1704", "tape",
       "%\n"
       "F1000X2000Y1000\n"
       "G03X1000Y2000I1000J1000\n"
       "X0Y1000\n"
       "G01X5000Y125\n"
       "X2500Y1000\n"
       "G00X0Y0\n"
       "M02\n"},
      {"itnc", "PART_5",
       "BEGIN PGM PART_5 MM\n"
       "L X+10 Y+0 Z+0 R0 F2000\n"
       "CC X+0 Y+0\n"
       "CP IPA-720 IZ-3 DR-\n"
       "LP PR+8 PA+60\n"
       "LBL \"STEP\" ; a repeat\n"
       "L IX+1.25 IY-0.5\n"
       "CALL LBL \"STEP\" REP 3\n"
       "L X+0 Y+0 Z+0 FMAX\n"
       "END PGM PART_5 MM\n"},
      {"tnc155", "5",
       "0 BEGIN PGM 5 MM\n"
       "1 L X+10 Y+0 Z+0 R0 F2000\n"
       "2 CC X+0 Y+0\n"
       "3 CP IPA-720 IZ-3 DR-\n"
       "4 LP PR+8 PA+60\n"
       "5 LBL 1\n"
       "6 L IX+1.25 IY-0.5\n"
       "7 CALL LBL 1 REP 3/3\n"
       "8 L X+0 Y+0 Z+0 FMAX\n"
       "9 END PGM 5 MM\n"},
  };
  return kPrograms;
}

namespace {

class Ends final : public machine::ExecutionSink {
 public:
  std::uint64_t executed = 0;
  void on_block_executed(const interpreter::Origin& origin) override { executed = origin.block; }
};

}  // namespace

BlockEnds simulated_ends(const DialectProgram& program) {
  const interpreter::Dialect& dialect = **interpreter::find_dialect(program.control);
  Ends sink;
  auto limits = machine::MachineLimits::mill();
  machine::SimulatedMachine machine(limits, {}, sink);
  machine.begin({});
  interpreter::MemorySource source(program.text);
  auto made = dialect.make({}, source, machine.events());
  BlockEnds ends;
  bool is_over = !made;
  for (int idle = 0; idle < 100;) {
    while (!is_over && machine.has_room()) {
      const StepState state = (*made)->step(1);
      if (state != StepState::Ran) is_over = true;
    }
    const std::uint64_t before = sink.executed;
    (void)machine.poll_all(1);
    (void)machine.resume();
    if (sink.executed == before) {
      ++idle;
      continue;
    }
    idle = 0;
    const auto position = machine.status().position;
    auto& end = ends[sink.executed];
    for (std::size_t i = 0; i < end.size(); ++i) end[i] = position.raw(static_cast<Axis>(i));
  }
  return ends;
}

}  // namespace dripline::test_support
