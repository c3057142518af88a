"""Moves a virtual XM430 with the PyPI package `dynamixel-api`, which names registers as a beginner likes it."""

import sys
import time

from dynamixel_api import DynamixelConnector, Motor, XL430W250T_FIELDS

# The XM430-W210 has these registers at the same addresses as the XL430-W250-T.


def main():
    if len(sys.argv) < 2:
        return  # installed
    with DynamixelConnector(XL430W250T_FIELDS, device=sys.argv[1], dynamixel_id=1) as connector:
        motor = Motor(connector)
        assert connector.read_field("model_number") == 1030
        motor.torque_enabled = False
        motor.operating_mode = 3
        motor.position_limit_low, motor.position_limit_high = 0, 4095
        motor.torque_enabled = True
        motor.goal_position = 1000
        assert motor.goal_position == 1000
        deadline = time.monotonic() + 10
        while motor.current_position != 1000:
            assert time.monotonic() < deadline, motor.current_position
    print("every call returned what the documents say")


main()
