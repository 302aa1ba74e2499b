# From single files to one data set, partitioned by split so that a changed test set
# reruns no training.


rule solve_terminal_shapes:
    output:
        "results/terminal_shapes/{split}.parquet",
    log:
        "results/logs/solve_terminal_shapes/{split}.log",
    benchmark:
        "results/benchmarks/solve_terminal_shapes/{split}.tsv"
    conda:
        "../../envs/simulate.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("solve_terminal_shapes"),
        B=lambda wildcards: STUDY.B_values(wildcards.split),
        options=STUDY.steady_options,
    message:
        "solve the terminal shapes of split {wildcards.split}"
    shell:
        "sedfiber solve_terminal_shapes --B {params.B} {params.options} -o {output} > {log} 2>&1"


rule solve_terminal_curve:
    output:
        "results/terminal_shapes/terminal_curve.parquet",
    log:
        "results/logs/solve_terminal_curve.log",
    benchmark:
        "results/benchmarks/solve_terminal_curve.tsv"
    conda:
        "../../envs/simulate.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("solve_terminal_curve"),
        options=STUDY.terminal_curve_options,
    message:
        "solve the terminal shapes over the whole range of the training"
    shell:
        "sedfiber solve_terminal_curve {params.options} -o {output} > {log} 2>&1"


rule aggregate_dataset:
    input:
        trajectories=lambda wildcards: trajectories(wildcards.split),
    output:
        "results/dataset/{split}.parquet",
    log:
        "results/logs/aggregate_dataset/{split}.log",
    benchmark:
        "results/benchmarks/aggregate_dataset/{split}.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        code=code_of("aggregate_dataset"),
    message:
        "aggregate split {wildcards.split}"
    shell:
        "sedfiber aggregate_dataset --split {wildcards.split} {input.trajectories}"
        " -o {output} > {log} 2>&1"


rule tabulate_regimes:
    input:
        splits=[test_files(split) for split in STUDY.splits],
    output:
        "results/tables/regimes.csv",
    log:
        "results/logs/tabulate_regimes.log",
    benchmark:
        "results/benchmarks/tabulate_regimes.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=5,
    params:
        code=code_of("tabulate_regimes"),
        splits=" ".join(" ".join(["--split", *test_files(split)]) for split in STUDY.splits),
    message:
        "tabulate how each fall turns and bends"
    shell:
        "sedfiber tabulate_regimes {params.splits} -o {output} > {log} 2>&1"


rule dataset:
    input:
        expand("results/dataset/{split}.parquet", split=STUDY.splits),
        expand("results/terminal_shapes/{split}.parquet", split=STUDY.splits),
