(expect PS113 6:6)
O1
G41D1G1X20.F100.
Y20.
(the wall that G40 is to aim at)
G40X0I5.J0
M30
