"""`python -m hooke` is the program `hooke`."""

from hooke_program import main

main()
