//! Inputs with errors close to the bounds, found by hill climbing over bits from corners of Hadamard's determinant
//! bound, one each for U, V, W, det and T. Rows: origin, direction, three corners.

use super::filter::Input;

/// Computed in single precision.
pub(crate) const SINGLE: [Input<u32>; 5] = [
    [
        [0xbf83_a635, 0x3f7e_4957, 0xbf76_336d],
        [0x3f80_0ab1, 0x3f7f_ffcf, 0x3f80_076f],
        [0xbce7_d7a0, 0xbbdf_85ff, 0xbc95_69df],
        [0x3f61_8ac9, 0x3efe_ed7a, 0xbf33_b6e1],
        [0xbf83_a6e9, 0xbf80_e66e, 0x3f7b_5da8],
    ],
    [
        [0xbf1a_2f26, 0x3f81_990d, 0x3f28_12be],
        [0x3f7f_f798, 0x3f7f_fff9, 0xbf80_0000],
        [0x3ecb_c6da, 0x3c46_ebc1, 0xbeaf_f56e],
        [0xbf1a_55a8, 0x3f81_94bc, 0xbfac_030e],
        [0xbdeb_2872, 0x3f11_1896, 0xbeda_ce80],
    ],
    [
        [0x3a1a_4f10, 0xba0f_2cf8, 0xba20_3161],
        [0x3f80_0988, 0x3f82_d942, 0xbf80_0d5c],
        [0x38d0_a003, 0xb860_c002, 0xb8c2_267f],
        [0x3f80_25e6, 0xbf80_0c32, 0x3f80_083f],
        [0xbf80_07e5, 0xbf80_068a, 0xbf80_05c1],
    ],
    [
        [0xbf84_8faf, 0xbf9b_f141, 0x3f63_3272],
        [0x3f80_3438, 0x3f80_0216, 0xbf80_3825],
        [0x3e59_ca44, 0xbd3a_c7d0, 0x3ccb_0ae0],
        [0x3f9b_4e8c, 0xbf85_ec64, 0x3f79_b1ef],
        [0x3f9b_55c8, 0x3f74_563e, 0x3f83_4adb],
    ],
    [
        [0x3f7f_81f5, 0xbf79_4910, 0x3f7e_711f],
        [0x403e_17ac, 0x3f31_01eb, 0x403e_c953],
        [0xbb13_51ff, 0x3cee_c1a1, 0xbc03_957f],
        [0xbf80_4a5c, 0x3f83_c00c, 0x3f7d_fd0d],
        [0x3f7f_9253, 0x3f83_c61d, 0xbf81_9153],
    ],
];

/// Computed in double precision.
pub(crate) const DOUBLE: [Input<u64>; 5] = [
    [
        [0x3fef_b14a_ee49_3fa6, 0x3ff0_53cb_4b7b_4ddf, 0xbff0_5e47_4fe7_0833],
        [0xbff0_000e_413f_6f91, 0x3ff0_0025_da62_2785, 0x3ff0_0000_00f4_e667],
        [0xbf84_ba25_3e99_efbf, 0x3f94_f2c6_3f6f_12a0, 0xbf98_1d78_49c3_8080],
        [0x3fd9_5f18_eb91_8500, 0x3fd4_961e_dcca_f85e, 0x3fc9_4918_bde4_8c81],
        [0x3fef_ad17_7a45_18fc, 0xbfef_5860_0841_69c3, 0x3fef_3f14_4197_b8f5],
    ],
    [
        [0x3fed_2316_61b7_0356, 0x3ff1_4dbf_0ad4_04bc, 0xbfea_32c7_0d5d_64e4],
        [0xbff0_0000_0786_3725, 0x3ff0_0d63_c3d2_4e4c, 0x3fef_fe63_3ac0_7d70],
        [0xbfb6_e74c_8f07_a8c8, 0x3fb4_dbf0_4039_f5f8, 0x3fc7_34e4_00a3_e5e4],
        [0xbff1_76d2_35f3_bbad, 0xbfed_6843_3024_3356, 0xbfea_32c7_0b89_1174],
        [0x3fc4_17e0_c71b_c948, 0x3fd7_2575_6616_46ae, 0x3fdc_6270_5d3f_081e],
    ],
    [
        [0x3f63_c69f_4ba2_629c, 0xbf63_e11d_d6d9_4574, 0x3f66_6f1e_2696_31bb],
        [0xbff0_0000_0cb2_d131, 0xbff0_0000_0d6d_068a, 0x3ff0_0379_651a_b4b1],
        [0x3f44_5610_e6d8_8c02, 0xbf3f_08ee_a692_d265, 0x3f49_a55f_4a48_d804],
        [0xbff0_0428_aea9_cdf4, 0x3fef_fc1f_b334_112d, 0xbfef_f97c_d6a7_53b6],
        [0xbfef_faea_9b78_848b, 0xbff0_01f0_9ae4_3334, 0xbfef_f996_a9ba_1e03],
    ],
    [
        [0xbfee_7799_62f1_0888, 0x4018_1c42_ca16_5c2f, 0xbfda_b17a_b47f_1b04],
        [0x3ff0_0000_01ea_3751, 0x3ff0_0000_02cd_dd83, 0xbff0_0000_01ea_8f8e],
        [0xbfd1_858d_5e80_6242, 0xbf91_ae36_6365_86a0, 0x3fc6_a395_d1c6_d6b4],
        [0xbff4_6172_4e91_34bd, 0x3fef_7762_f309_b0f0, 0xbfea_570b_0607_95c2],
        [0x3fe7_3d39_569a_65e0, 0x3fef_728e_54ed_cc40, 0x3ff2_d472_bca5_e299],
    ],
    [
        [0x3ff0_5c03_ef1f_5293, 0xbff0_3e05_a5b1_55cc, 0xbfef_cb77_c82e_6d69],
        [0xbffd_817e_7f66_9169, 0x3ffd_097a_af48_5bd2, 0xc006_d77a_3ffd_08b3],
        [0x3f96_d425_ec56_9ae1, 0xbf8f_02c3_238a_20bf, 0x3f7a_4423_e5e3_a301],
        [0xbfef_495e_db5d_1538, 0x3fef_849e_4ac5_b14f, 0xbfef_cb77_c52a_95bf],
        [0xbfef_495e_da7f_817e, 0xbff0_3e07_8081_7042, 0x3ff0_1403_6870_5f11],
    ],
];

/// Single precision, computed in double precision.
pub(crate) const MIXED: [Input<u32>; 5] = [
    [
        [0xbf80_2aae, 0xbf82_d9f0, 0x3f80_ff1a],
        [0xbf80_06d3, 0x3f80_0144, 0x3f80_03c1],
        [0xac4c_ee00, 0xaea7_a9d1, 0x2ec3_ad10],
        [0x3f55_7349, 0xbe6f_9077, 0xbf6c_f605],
        [0xbf80_03a8, 0x3f80_010b, 0xbf80_0324],
    ],
    [
        [0x3f80_0804, 0xbf80_054a, 0x3f80_02d7],
        [0xbf80_0276, 0xbf80_3904, 0xbf7f_675b],
        [0x3047_54a6, 0x2fdc_7dec, 0xb058_372e],
        [0xbf80_06d0, 0x3f80_037d, 0x3f80_035f],
        [0xbf65_0e14, 0xbf65_5609, 0xbe4c_f4cd],
    ],
    [
        [0x3a87_c04b, 0x3a7e_ec18, 0xba6b_c4dd],
        [0x3f80_010b, 0xbf80_047e, 0x3f80_3e69],
        [0x2b86_6c5d, 0xab99_93e0, 0x2b81_4451],
        [0x3f80_2ac2, 0x3f80_1138, 0xbf80_0484],
        [0xbf81_54d8, 0x3f80_0cfe, 0x3f80_6b40],
    ],
    [
        [0xbf04_9e5e, 0xbed8_f6c9, 0x3f17_d1ee],
        [0x3f80_1945, 0x3f80_06e5, 0xbf80_0de4],
        [0xade3_61bf, 0xade8_2ec0, 0x2e20_4ae0],
        [0x3f80_7a1b, 0xbf80_2002, 0xbf80_7766],
        [0x3f80_0edd, 0x3f80_0259, 0x3f80_086c],
    ],
    [
        [0x3f80_0439, 0xbf80_4fc0, 0xbf80_0783],
        [0xbe84_312f, 0xbffe_37dd, 0xbfa0_7d63],
        [0xad0e_937f, 0x2e28_8560, 0x2d9c_ed40],
        [0xbf80_00af, 0x3f80_0349, 0xbf80_01e0],
        [0x3f80_baa1, 0x3f80_6249, 0x3f80_2612],
    ],
];
