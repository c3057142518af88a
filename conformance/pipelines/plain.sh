#!/bin/sh
# For any other server: the verdict is the exit status.
set -eu
pip install . actucheck==0.1.0
actucheck codec --expect expected-failures.yaml --report junit=junit.xml -- python adapter.py
