/* Name of main() of cli/main.c in the tests of faults. */
#pragma once

int hooke_program_main(int argc, char **argv);
