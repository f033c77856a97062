g 1 x 1 . 2 5 z - . 5 f 1 0
N 1 0 X 2
P 1 = 5 * [ 2 + 1 ]p r i n t [ #1 ]

%
(A COMMENT) X3 (ANOTHER) Z1
