#!/usr/bin/env bash
# Segments the frames of some inputs as a Slurm job array:
#
#   sbatch --array=1-64 doc/cluster/slurm.sh OUTPUT_FOLDER INPUT...
#
# A task that was lost is started again alone, with the size of the whole array:
#
#   PARTS=64 sbatch --array=17 doc/cluster/slurm.sh OUTPUT_FOLDER INPUT...
#SBATCH --job-name=plane_segmentation
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail
output=$1
shift

exec srun "${APP:-pcl_mrf_plane_segmentation}" "$@" --output-folder "$output" \
  --shard "$SLURM_ARRAY_TASK_ID/${PARTS:-$SLURM_ARRAY_TASK_COUNT}" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" --resume
