(expect NGC0113 2:1)
#5420=1
M2
