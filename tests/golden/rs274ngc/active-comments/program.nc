#1=1 #<x>=2.5
(DEBUG,#1 is %d#1 %.2f#<x> %f#<x>)
(PRINT,none: #<y>)
(LOGOPEN,result.txt)
(LOG,x=#<x>)
(LOGAPPEND, more.txt )
(LOGCLOSE)
(print,lower #1) ; not this
M2
