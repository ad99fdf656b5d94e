#!/bin/sh
# A sweep on several machines: a Slurm job array of eight tasks, each of which runs an eighth of the points.
#
#   sbatch slurm_array.sh grid.toml
#
# When all tasks are done:
#
#   flap results merge grid.csv grid.*of8.csv
#
# After a node failure or a preemption, Slurm starts the task again (--requeue).
# If a task ran out of time or was cancelled, submit it again, for example task 3. It continues its shard:
#
#   sbatch --array=3 slurm_array.sh grid.toml

#SBATCH --job-name=flap
#SBATCH --array=1-8
#SBATCH --cpus-per-task=16
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --signal=B:TERM@60

# If flap is not in the PATH of a job, load it here, for example: . ~/flap/.venv/bin/activate

# The number of shards. It equals the last number of --array above.
shards=8

exec flap sweep "$1" --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "$SLURM_CPUS_PER_TASK"
