# Generated from CMakeLists.txt and firmware/io/can/supercoil.dbc by toolchain/generate-can. Do not edit.

__version__ = "0.2.0"
PROTOCOL_VERSION = 5
