#!/usr/bin/env python3
"""Asks a program the cases of this folder, without cargo: python3 spec/suite/conform.py -- ./mine"""

from stackless_conform.__main__ import main

if __name__ == "__main__":
    main()
