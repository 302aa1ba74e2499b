# From single files to one data set, partitioned by split so that a changed test set
# reruns no training.


rule solve_terminal_shapes:
    output:
        "results/terminal_shapes/{split}.parquet",
    log:
        "results/logs/solve_terminal_shapes/{split}.log",
    params:
        code=code_of("solve_terminal_shapes"),
        settings=lambda wildcards: as_json(STUDY.terminal_shapes_settings(wildcards.split)),
    shell:
        "sedfiber solve_terminal_shapes --settings {params.settings:q} -o {output} > {log} 2>&1"


rule solve_terminal_curve:
    output:
        "results/terminal_shapes/terminal_curve.parquet",
    log:
        "results/logs/solve_terminal_curve.log",
    params:
        code=code_of("solve_terminal_curve"),
        settings=as_json(STUDY.terminal_curve_settings),
    shell:
        "sedfiber solve_terminal_curve --settings {params.settings:q} -o {output} > {log} 2>&1"


rule aggregate_dataset:
    input:
        lambda wildcards: trajectories(wildcards.split),
    output:
        "results/dataset/{split}.parquet",
    log:
        "results/logs/aggregate_dataset/{split}.log",
    resources:
        mem_mb=2000,
    params:
        code=code_of("aggregate_dataset"),
        settings=lambda wildcards: as_json({"split": wildcards.split}),
    shell:
        "sedfiber aggregate_dataset {input} --settings {params.settings:q} -o {output} > {log} 2>&1"


rule tabulate_regimes:
    input:
        [split_files(split) for split in STUDY.splits],
    output:
        "results/tables/regimes.csv",
    log:
        "results/logs/tabulate_regimes.log",
    resources:
        mem_mb=2000,
    params:
        code=code_of("tabulate_regimes"),
    shell:
        "sedfiber tabulate_regimes {input} -o {output} > {log} 2>&1"


rule dataset:
    input:
        expand("results/dataset/{split}.parquet", split=STUDY.splits),
        expand("results/terminal_shapes/{split}.parquet", split=STUDY.splits),
