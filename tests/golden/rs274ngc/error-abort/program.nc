(expect NGC0310 3:0)
#1=4
(ABORT,wear #1)
M2
