#!/usr/bin/env bash
# timed.sh FILE PROGRAM [ARGUMENT...]: runs a test, and writes the times of the processor that it and what it started took.
"${@:2}"
code=$?
times >"$1"
exit $code
