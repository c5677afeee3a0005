"""ros2 launch ./finger.launch.py address:=can0 node:=1

Starts the bridge, robot_state_publisher and ros2_control with a trajectory controller, for finger.urdf. It does not arm."""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

HERE = Path(__file__).resolve().parent


def generate_launch_description():
    description = {"robot_description": (HERE / "finger.urdf").read_text()}
    controllers = str(HERE / "controllers.yaml")
    spawn = [Node(package="controller_manager", executable="spawner", arguments=[name])
             for name in ("joint_state_broadcaster", "finger_controller")]
    return LaunchDescription([
        DeclareLaunchArgument("address", default_value="can0"),
        DeclareLaunchArgument("node", default_value="1"),
        ExecuteProcess(cmd=["supercoil-ros", LaunchConfiguration("address"),
                            "--joint", ["finger=", LaunchConfiguration("node")],
                            "--states", "/supercoil/joint_states"], output="screen"),
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description]),
        Node(package="controller_manager", executable="ros2_control_node", parameters=[description, controllers]),
        *spawn,
    ])
