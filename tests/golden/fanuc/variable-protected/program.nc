(expect PS116 3:1)
O0605
#0=1
M30
