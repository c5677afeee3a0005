"""Muscles as joints of ROS 2, over DDS and without ROS on this machine (docs/ros.md).

Needs Eclipse Cyclone DDS: pip install "supercoil[ros]". The command is supercoil-ros.
"""
