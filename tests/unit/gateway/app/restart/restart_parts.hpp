#pragma once

namespace dripline::gateway {

/// A program for each control, with what a restart has to bring back: a subprogram, a loop,
/// compensation and a cycle, as far as the control has them.
struct Part {
  const char* control;
  const char* setup;
  const char* program;
};
inline constexpr Part kParts[] = {
    {"centurion", "[[tool]]\nnumber = 2\nradius = 0.05\ntip = 3\n",
     "O0001\nT0202 M6\nG97 S800 M3\nM8\nP1=0\nWHILE P1<12\nG0 X4 Z1\nG98 F20\nG42 G1 X2 "
     "Z.1\nZ-1\nX3 "
     "Z-2\nG2 X4 Z-2.5 R.5\nG1 X6\nG40 X7 Z-2\nGOSUB 100 L3\nG0 X0 Z.3\nG83 R.1 Z-1 V-.3 Q.35 E.04 "
     "F5\nP1=P1+1\nWEND\nM30\nN100 G91 G1 Z.02\nX.01\nG93\nRETURN\n"},
    {"fanuc", "[[tool]]\nnumber = 1\nradius = 4.0\n",
     "O0540\nT1 M06\nM03 S900\nM08\n#1=1\nWHILE[#1LE15]DO1\nG90 G17 G00 X-15. Y-15. Z5.\nG01 Z-1. "
     "F900\nG41 G01 "
     "X0 "
     "Y0 D1 F900\nY30.\nX[30.+#1]\nY0\nX0\nG40 X-15. Y-15.\nM98 P30561\nG99 G83 X1. Z-10. R2. Q3. "
     "F600\nX5.\nX[9.+#1]\nG80\n#1=#1+1\nEND1\nM30\nO0561\nG91 G01 X2. F500\nG02 X1. Y1. I1. "
     "J0\nG90 "
     "M99\n"},
    {"fanuc-t", "",
     "O0542\nG21 G40\n#1=1\nWHILE[#1LE6]DO1\nT0101\nG97 S900 M03\nM08\nG00 X52. Z2.\nG71 U2. "
     "R.5\nG71 "
     "P10 Q20 U.4 W.1 F.3\nN10 G00 X30.\nG01 Z-10.\nN20 X50. Z-[20+#1]\nG42 G00 X34. Z4.\nG01 "
     "X30. "
     "Z1.\nZ-10.\nX54. Z-22.\nG40 G00 X60.\nG00 Z-25.\nG75 R.5\nG75 X44. Z-28. P1500 Q1500 "
     "F.1\nM98 "
     "P543\nG00 X60.\nX0 Z0\n#1=#1+1\nEND1\nM30\nO0543\nG01 U2. F.2\nW-1.\nM99\n"},
    {"rs274ngc",
     "units = \"mm\"\n[[tool]]\nnumber = 1\nradius = 2.0\n[control]\nprofile = \"linuxcnc\"\n",
     "G21 G90 F900\no1 sub\nG91 G1 X1\nG2 X1 Y1 I1 J0\nG90\no1 endsub\nT1 M6\nM3 "
     "S700\nM7\n#1=0\no2 while "
     "[#1 lt 15]\nG40 G0 X-20 Y-20 Z3\nG1 Z-1\nG41 D1 G1 X0 Y0\nY[30+#1]\nX30\nY0\nX0\nG40 G1 X-20 "
     "Y-20\no1 "
     "call\no1 call\nG99 G83 X5 Y5 Z-8 R2 Q1.5 F500\nX[10+#1]\nG80\n#1=[#1+1]\no2 endwhile\nM2\n"},
    {"tnc155", "",
     "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0,000 R+4\n2 TOOL CALL 1 Z S 500,000\n3 L Z+5 R0 F MAX "
     "M03\n4 LBL 1\n5 L X+0 Y-20 R0 F MAX\n6 L Z-1 R0 F900\n7 L X+0 Y+0 RR F900\n8 L X+40 Y+0\n9 L "
     "X+40 Y+30\n10 L X+0 Y+0\n11 L X-20 Y-20 R0\n12 CALL LBL 5 REP\n13 CYCL DEF 4.0 POCKET "
     "MILLING\n14 CYCL DEF 4.1 SET-UP -2,000\n15 CYCL DEF 4.2 DEPTH -3,000\n16 CYCL DEF 4.3 "
     "PECKING -2,000 F600\n17 CYCL DEF 4.4 X+40,000\n18 CYCL DEF 4.5 Y+22,000\n19 CYCL DEF 4.6 "
     "F900 DR+\n20 L X+50,000 Y+30,000 R0 F9999 M99\n21 CALL LBL 1 REP 7/7\n22 STOP M02\n23 LBL "
     "5\n24 L IX+1 R0 F900\n25 L IY+1\n26 LBL 0\n27 END PGM 1 MM\n"},
    {"prototrak-plus", "",
     "PN1 G20 ;\nN1 G100 X1. Y1. T1 ;\nN2 G101 XB0 YB0 XE4. YE0 F100 TC1 D0.5 CR0.5 T2 ;\nN3 G101 "
     "XB0I "
     "YB0I XE4. YE3. CR0 ;\nN4 G101 XB0I YB0I XE0 YE3. CR0.1 ;\nN5 G101 XB0I YB0I XE0 YE0 CR- "
     ";\nN6 "
     "G100 X1. Y2. ;\nN7 G105 FE1 LE6 XO2. YO0.5 RE9 T7 ;\nN8 G106 XB0 YB0 XD4. YD2. DR1 TC0 FC0 "
     "F90 "
     "D0.5 CR0.5 T4 ;\n%\n"},
    {"tektronix-1704", "",
     "%\nF100M03\nZ20000\nG81X10000Y10000R1000Z-"
     "5000\nX20000\nG82X30000\nG85X40000\nG00Z20000\nG01F40Z1000\nX20000"
     "Y10000\nG03X10000Y20000I10000J10000\nX0Y10000\nG02X10000Y20000\nG01X0\nY0\nX30000\nY5000\nX0Y"
     "0\n"
     "G81X10000Y10000R1000Z-5000\nX20000\nX25000\nX35000\nG00Z20000\nM02\n"}};

}  // namespace dripline::gateway
