#!/bin/bash
# An array job: sbatch campaign/slurm.sh. Then: stackless merge records/*.json
#SBATCH --array=1-64
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -euo pipefail
mkdir -p records
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}
exec stackless --quiet check --trees 10000000 --seed 20261124 \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --json "records/$SLURM_ARRAY_TASK_ID.json"
